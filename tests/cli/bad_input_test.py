# SPDX-License-Identifier: MIT
"""Bad input to `sherd-bake bake` and `layout`: its own exit code, a message with the place and a way
out, and nothing written."""
import os
import unittest

import inputs
from command_case import CommandCase, EXIT


class BadModels(CommandCase):
    def setUp(self):
        super().setUp()
        self.map = self.write('map.svg', inputs.two_level_svg())

    def refuse_model(self, name, data, code, mentions):
        model = self.write(name, data)
        self.refuse_bake(model, [self.map], code, [name, *mentions])

    def test_a_missing_model_is_named(self):
        for name in ('gone.glb', 'gone.gltf', 'gone.obj'):
            self.refuse_bake(self.dir / name, [self.map], 'FileNotFound', [name, 'does not exist'])

    def test_a_folder_is_no_model(self):
        (self.dir / 'folder.glb').mkdir()
        self.refuse_bake(self.dir / 'folder.glb', [self.map], 'FileRead', ['folder.glb'])

    def test_a_model_of_an_unknown_kind_is_refused_with_the_known_ones(self):
        self.refuse_model('model.fbx', b'Kaydara', 'Unsupported', ['.glb', '.obj'])

    def test_a_glb_cut_short_at_any_length_is_refused(self):
        whole = inputs.textured_cube_glb()
        document = len(whole) - 28 - len(inputs.unpack_glb(whole)[1])
        for length in (0, 1, 3, 4, 11, 12, 15, 19, 20, 21, 20 + document // 2, 20 + document,
                       24 + document, 28 + document, len(whole) // 2, len(whole) - 4,
                       len(whole) - 1):
            with self.subTest(length=length):
                self.refuse_model('short.glb', whole[:length], 'Malformed', [])

    def test_a_gltf_cut_short_is_refused(self):
        whole = inputs.missing_buffer_gltf()
        for length in (0, 1, len(whole) // 2, len(whole) - 1):
            with self.subTest(length=length):
                self.refuse_model('short.gltf', whole[:length], 'Malformed', [])

    def test_a_gltf_whose_buffer_is_missing_names_it(self):
        self.refuse_model('model.gltf', inputs.missing_buffer_gltf(), 'FileNotFound', ['gone.bin'])

    def test_an_obj_cut_short_within_a_face_is_refused(self):
        whole = inputs.model_obj()
        self.refuse_model('short.obj', whole[:whole.rindex(b'f ') + 3], 'Malformed', ['three corners'])

    def test_a_glb_that_is_text_is_refused(self):
        self.refuse_model('text.glb', b'this is no model at all, sorry', 'Malformed', [])

    def test_a_mesh_without_texture_coordinates_is_sent_to_be_unwrapped(self):
        self.refuse_model('bare.glb', inputs.model_glb(texcoords=False), 'NoTextureCoordinates',
                          ['cube', 'unwrap'])
        self.refuse_model('bare.obj', inputs.model_obj(texcoords=False), 'NoTextureCoordinates',
                          ['unwrap'])

    def test_an_open_mesh_is_refused_with_an_edge_and_the_option_for_it(self):
        open_mesh = inputs.open_cube_mesh()
        self.refuse_model('open.glb', inputs.model_glb(open_mesh), 'OpenMesh',
                          ['16 edges', 'edge from (', '--allow-open'])
        self.refuse_model('open.obj', inputs.model_obj(open_mesh), 'OpenMesh',
                          ['16 edges', '--allow-open'])

    def test_a_non_manifold_mesh_is_refused_with_an_edge_and_the_option_for_it(self):
        self.refuse_model('fin.glb', inputs.model_glb(inputs.non_manifold_cube_mesh()),
                          'NonManifoldMesh', ['edge from (', '--allow-open'])

    def test_a_mesh_inside_out_is_refused(self):
        self.refuse_model('inverted.glb', inputs.model_glb(inputs.inside_out_cube_mesh()),
                          'InvalidData', ['inside out'])

    def test_a_skinned_mesh_is_refused_with_the_reason(self):
        self.refuse_model('skinned.glb', inputs.skinned_cube_glb(), 'SkinnedMesh',
                          ['/nodes/0/skin', 'skinned', 'static mesh'])

    def test_a_morphed_mesh_is_refused_with_the_reason(self):
        self.refuse_model('morphed.glb', inputs.morphed_cube_glb(), 'SkinnedMesh',
                          ['morphed', 'static mesh'])

    def test_a_required_extension_nobody_knows_is_named(self):
        self.refuse_model('future.glb', inputs.required_extension_glb(), 'UnsupportedExtension',
                          ['VENDOR_unheard_of', '/extensionsRequired/0'])

    def test_an_index_out_of_range_is_refused_with_its_place(self):
        self.refuse_model('wild.glb', inputs.out_of_range_index_glb(), 'InvalidData',
                          ['/accessors/', '65000'])

    def test_a_mesh_of_lines_has_nothing_to_break(self):
        self.refuse_model('lines.glb', inputs.no_triangles_glb(), 'NoTriangles', ['triangles'])


class BadMaps(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.model_glb())

    def refuse_map(self, name, data, code, mentions):
        self.refuse_bake(self.model, [self.write(name, data)], code, mentions)

    def test_a_missing_map_is_named(self):
        self.refuse_bake(self.model, [self.dir / 'gone.svg'], 'FileNotFound',
                         ['gone.svg', 'does not exist'])

    def test_a_later_map_is_looked_at_like_the_first(self):
        first = self.write('halves.svg', inputs.halves_svg())
        self.refuse_bake(self.model, [first, self.dir / 'gone.svg'], 'FileNotFound', ['gone.svg'])

    def test_an_empty_map_is_refused_with_what_was_passed_over(self):
        self.refuse_map('empty.svg', inputs.empty_svg(), 'EmptyMap',
                        ['empty.svg', '1 text', '1 defs', 'draw'])
        self.refuse_map('empty.svg', inputs.svg(''), 'EmptyMap', ['empty.svg', 'draw'])
        self.refuse_map('empty.json', b'{"sherdMap": 1, "lines": []}', 'EmptyMap', ['empty.json'])

    def test_a_map_that_separates_nothing_is_refused(self):
        self.refuse_map('line.svg', inputs.separates_nothing_svg(), 'SeparatesNothing',
                        ['cube.glb', 'level 1', 'draw lines that close'])

    def test_a_second_level_that_separates_nothing_more_is_refused(self):
        same = self.write('same.svg', inputs.halves_svg())
        self.refuse_bake(self.model, [same, same], 'SeparatesNothing', ['level 2'])

    def test_a_map_that_is_no_xml_is_refused(self):
        for text in (b'', b'not a drawing', b'\x89PNG\r\n\x1a\n\0\0', b'<svg><path d="M0'):
            with self.subTest(text=text):
                self.refuse_map('broken.svg', text, 'Malformed', ['broken.svg'])

    def test_a_map_of_another_xml_kind_is_refused(self):
        self.refuse_map('page.svg', b'<html><body/></html>', 'Malformed', ['page.svg', '<html>'])

    def test_a_map_cut_short_is_refused(self):
        whole = inputs.two_level_svg()
        for length in (10, len(whole) // 2, len(whole) - 4):
            with self.subTest(length=length):
                self.refuse_map('short.svg', whole[:length], 'Malformed', ['short.svg'])

    def test_a_json_map_that_is_not_json_is_refused(self):
        self.refuse_map('broken.json', b'{"sherdMap": 1, "lines": [', 'Malformed', ['broken.json'])
        self.refuse_map('other.json', b'{"other": 1}', 'Malformed', ['other.json', 'sherdMap'])

    def test_a_map_of_an_unknown_kind_is_refused(self):
        self.refuse_map('map.dxf', b'0\nSECTION\n', 'Unsupported', ['map.dxf', '.svg'])


class BadOutputs(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.model_glb())
        self.map = self.write('map.svg', inputs.two_level_svg())

    def refuse_output(self, output, mentions):
        self.refuse(['bake', self.model, '--map', self.map, '-o', output], 'FileWrite',
                    [str(output), *mentions])
        self.refuse(['layout', self.model, '-o', output], 'FileWrite', [str(output), *mentions])

    def test_a_folder_that_does_not_exist(self):
        self.refuse_output(self.dir / 'gone' / 'out.glb', ['does not exist'])

    def test_a_folder_in_the_place_of_the_file(self):
        (self.dir / 'folder').mkdir()
        self.write('folder/kept.txt', b'kept')
        self.refuse_output(self.dir / 'folder', ['directory'])

    def test_a_file_in_the_place_of_the_folder(self):
        self.write('file', b'a file')
        self.refuse_output(self.dir / 'file' / 'out.glb', ['not a directory'])

    def test_a_folder_one_may_not_write_to(self):
        folder = self.dir / 'locked'
        folder.mkdir(0o555)
        if os.geteuid() == 0:  # root may write everywhere: be somebody else
            self.dir.chmod(0o777)
            self.user = 65534
            if not self.may_run():
                self.skipTest('only root may run the program under test')
        self.refuse_output(folder / 'out.glb', ['permission'])
        self.refuse_bake(self.model, [self.map], 'FileWrite', ['report.json', 'permission'],
                         ['--report', folder / 'report.json'])

    def test_a_full_disk_leaves_nothing(self):
        result = self.run_bake('bake', self.model, '--map', self.map, '-o', '/dev/full')
        self.assertEqual(result.returncode, EXIT['FileWrite'])
        self.assertEqual(result.stdout, '')
        self.assertIn('/dev/full', result.stderr)

    def test_a_report_that_cannot_be_written_keeps_the_bake_from_being_written(self):
        (self.dir / 'folder').mkdir()
        for report in ('folder', 'gone/report.json'):
            self.refuse_bake(self.model, [self.map], 'FileWrite', [report], ['--report', report])
        self.refuse_bake(self.model, [self.map], 'FileWrite', ['/dev/full'],
                         ['--report', '/dev/full'])

    def test_a_report_in_the_place_of_the_output_is_refused(self):
        self.refuse_bake(self.model, [self.map], 'BadArgument', ['out.glb'],
                         ['--report', self.dir / '.' / 'out.glb'])


    def test_an_output_in_the_place_of_an_input_is_refused(self):
        self.refuse(['bake', self.model, '--map', self.map, '-o', self.map], 'BadArgument',
                    ['map.svg', 'overwrite'])
        recipe = self.write('recipe.json', b'{"levels": [{"map": "map.svg"}]}')
        for output in (self.map, recipe):
            self.refuse(['bake', self.model, '--recipe', recipe, '-o', output], 'BadArgument',
                        [output.name, 'overwrite'])
        for report in (self.map, self.model):
            self.refuse_bake(self.model, [self.map], 'BadArgument', [report.name, 'overwrite'],
                             ['--report', report])

    def test_an_empty_model_is_called_empty(self):
        empty = self.write('empty.glb', b'')
        self.refuse_bake(empty, [self.map], 'Malformed', ['empty.glb', 'the file is empty'])

    def test_a_shell_that_is_no_number_thick_is_refused(self):
        for thickness in ('nan', '-1', '0', '1e300'):
            self.refuse_bake(self.model, [self.map], 'Usage', ['not a number from'],
                             ['--shell-thickness', thickness])

    def test_a_template_of_another_kind_is_refused(self):
        other = self.write('other.glb', b'precious')
        self.refuse(['layout', self.model, '-o', other], 'BadArgument', ['other.glb', '.svg'])
        self.assertEqual(other.read_bytes(), b'precious')

    def test_an_output_of_another_kind_is_refused(self):
        for name in ('out.gltf', 'out.OBJ'):
            self.refuse(['bake', self.model, '--map', self.map, '-o', self.dir / name],
                        'BadArgument', [name, '.glb'])

    def test_results_that_nobody_received_are_no_success(self):
        for arguments in (['bake', self.model, '--map', self.map, '-o', self.dir / 'out.glb'],
                          ['check', '--json', self.dir / 'out.glb']):
            with open('/dev/full', 'w', encoding='ascii') as full:
                result = self.run_bake(*arguments, stdout=full)
            self.assertEqual(result.returncode, EXIT['FileWrite'])
            self.assertIn('standard output', result.stderr)


class BadCommandLines(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.model_glb())
        self.map = self.write('map.svg', inputs.two_level_svg())

    def refuse_usage(self, arguments, mentions=()):
        self.refuse(arguments, 'Usage', mentions)

    def test_no_or_an_unknown_subcommand(self):
        self.refuse_usage([])
        self.refuse_usage(['brake', self.model])

    def test_an_unknown_option_is_named(self):
        for command in ('bake', 'layout', 'check', 'export'):
            self.refuse_usage([command, self.model, '-o', self.dir / 'x', '--sharpen'],
                              ['--sharpen'])

    def test_missing_arguments_are_named(self):
        self.refuse_usage(['bake', self.model, '--map', self.map], ['--output'])
        self.refuse_usage(['bake'], ['MODEL'])
        self.refuse_usage(['export', self.model], ['--output'])
        self.refuse_usage(['check'], ['BAKED'])

    def test_values_outside_their_range(self):
        for option, value in (('--threads', '0'), ('--density', '-1'), ('--density', 'heavy'),
                              ('--tolerance', '1'), ('--seam-join', '2'),
                              ('--interior', 'jelly')):
            with self.subTest(option=option):
                self.refuse_usage(['bake', self.model, '--map', self.map, '-o',
                                   self.dir / 'out.glb', option, value], [option])

    def test_no_map_at_all(self):
        self.refuse_bake(self.model, [], 'BadArgument', ['--map'])

    def test_an_unknown_node_is_answered_with_the_known_ones(self):
        model = self.write('two.glb', inputs.two_cubes_glb())
        for node in ('middle', '7'):
            self.refuse_bake(model, [self.map], 'BadArgument', [node, 'left', 'right/one'],
                             ['--node', node])

    def test_an_unknown_uv_set_is_refused(self):
        self.refuse_bake(self.model, [self.map], 'NoTextureCoordinates', ['cube'], ['--uv', '1'])

    def test_a_recipe_that_is_missing_or_wrong(self):
        self.refuse_bake(self.model, [self.map], 'FileNotFound', ['gone.json'],
                         ['--recipe', 'gone.json'])
        broken = self.write('broken.json', b'{"levels": [')
        self.refuse_bake(self.model, [self.map], 'Malformed', ['broken.json'],
                         ['--recipe', broken])


if __name__ == '__main__':
    unittest.main()
