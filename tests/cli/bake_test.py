# SPDX-License-Identifier: MIT
"""The way from a model and a drawing to pieces: bake, check, export."""
import json
import os
import pty
import re
import unittest

import inputs
import obj_check
from command_case import CommandCase, EXIT


def names(folder):
    return sorted(str(p.relative_to(folder)) for p in folder.rglob('*') if p.is_file())


TWO_LEVELS = ['level0_fragment0.obj', 'level1_fragment0.obj', 'level1_fragment1.obj',
              'level2_fragment0.obj', 'level2_fragment1.obj', 'level2_fragment2.obj']


class Baking(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.textured_cube_glb())
        self.map = self.write('map.svg', inputs.two_level_svg())
        self.out = self.dir / 'out.glb'

    def bake(self, *extra, model=None, out=None):
        return self.succeed('bake', model or self.model, '-o', out or self.out, '--map', self.map,
                            *extra)

    def test_a_bake_passes_check_and_says_what_came_out(self):
        result = self.bake()
        self.assertEqual(result.stderr, '')
        rows = [line.split() for line in result.stdout.splitlines()]
        self.assertEqual(rows[0], ['object', 'level', 'fragments', 'components', 'closed', 'volume',
                                   'hidden'])
        self.assertEqual(rows[1][:5], ['cube', '0', '1', '1', '100%'])
        self.assertEqual(rows[2][:4], ['1', '2', '2', '100%'])
        self.assertEqual(rows[3][:4], ['2', '3', '3', '100%'])
        checked = self.succeed('check', self.out)
        self.assertEqual(checked.stderr, '')
        self.assertTrue(checked.stdout.endswith('check passed\n'))
        self.assertNotIn('FAILED', checked.stdout)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()),
                         ['cube.glb', 'map.svg', 'out.glb'])

    def test_geometry_is_compressed_where_the_build_has_draco(self):
        compressed = ('--encoding', 'draco')
        if os.environ.get('SHERD_DRACO') == '1':
            self.bake()
            plain = self.out.stat().st_size
            self.bake(*compressed)
            self.assertLess(self.out.stat().st_size, plain)
            document = inputs.unpack_glb(self.out.read_bytes())[0]
            self.assertEqual(document['extensionsUsed'], ['SHERD_mesh_fracture'])
            self.assertNotIn('extensionsRequired', document)
            self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
        elif 'SHERD_DRACO' in os.environ:
            self.refuse(['bake', self.model, '-o', self.out, '--map', self.map, *compressed],
                        'Unsupported', ['SHERD_DRACO=ON'])

    def test_a_thickness_without_a_shell_is_told(self):
        thickness = ('--shell-thickness', '0.1')
        self.assertIn('note shell-unused', self.bake(*thickness).stdout)
        self.assertNotIn('shell-unused', self.bake(*thickness, '--interior', 'shell').stdout)

    def test_cuts_through_the_volume_need_no_drawing(self):
        self.succeed('bake', self.model, '-o', self.out, '--cut', 'voronoi:5', '--cut',
                     'slices:2x1x1:larger=0.1')
        self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
        self.bake('--cut', 'voronoi:3')
        self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
        wrong = self.run_bake('bake', self.model, '-o', self.out, '--cut', 'voronoy:5')
        self.assertEqual(wrong.returncode, EXIT['BadArgument'])
        self.assertIn('voronoi:N', wrong.stderr)

    def test_levels_stand_in_the_order_of_the_command_line(self):
        counts = {}
        for order in (('cut', 'pattern'), ('pattern', 'cut')):
            level = {'cut': ['--cut', 'slices:1x1x3'], 'pattern': ['--pattern', 'grid:2x1']}
            self.succeed('bake', self.model, '-o', self.out, '--interior', 'solid',
                         '--report', self.dir / 'r.json', *level[order[0]], *level[order[1]])
            self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
            report = json.loads((self.dir / 'r.json').read_text())
            counts[order] = [level['fragments'] for level in report['objects'][0]['levels']]
        self.assertEqual(counts[('cut', 'pattern')], [1, 3, 6])
        self.assertEqual(counts[('pattern', 'cut')], [1, 2, 6])

    def test_a_drawing_cuts_straight_through_the_volume(self):
        drawing = self.write('cross.svg', b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 4">'
                             b'<path d="M-1 2H5M2 -1V5M-1 -1H5V5H-1Z" stroke="black"/></svg>')
        self.succeed('bake', self.model, '-o', self.out, '--cut', f'map:{drawing}:axis=z',
                     '--cut', f'map:{drawing}:axis=x:larger=0.1', '--report', self.dir / 'r.json')
        report = json.loads((self.dir / 'r.json').read_text())
        levels = report['objects'][0]['levels']
        self.assertEqual([level['fragments'] for level in levels], [1, 4, 8])
        for level in levels[1:]:
            self.assertEqual(level['closed'], level['fragments'])
            self.assertEqual(level['coverage'], {'none': 0, 'double': 0})
        self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
        recipe = self.write('r.json', b'{"levels": [{"cut": "map:cross.svg:axis=y"}]}')
        self.succeed('bake', self.model, '-o', self.out, '--recipe', recipe)
        as_text = self.out.read_bytes()
        recipe = self.write('r.json', b'{"levels": [{"cut": {"map": "cross.svg", "axis": "y"}}]}')
        self.succeed('bake', self.model, '-o', self.out, '--recipe', recipe)
        self.assertEqual(self.out.read_bytes(), as_text)
        recipe = self.write('r.json', b'{"levels": [{"cut": {"map": "cross.svg", "axis": "up"}}]}')
        wrong = self.run_bake('bake', self.model, '-o', self.out, '--recipe', recipe)
        self.assertNotEqual(wrong.returncode, 0)
        self.assertRegex(wrong.stderr, 'r.json#/levels/0/cut/axis: .*"x", "y", "z"')
        for cut, says in ((f'map:{self.dir}/none.svg', 'exist'), (f'map:{self.map}:axis=q', 'x, y, z')):
            wrong = self.run_bake('bake', self.model, '-o', self.out, '--cut', cut)
            self.assertNotEqual(wrong.returncode, 0)
            self.assertIn(says, wrong.stderr)

    def test_clusters_take_their_places_among_the_levels(self):
        made = self.succeed('bake', self.model, '-o', self.out, '--cluster', '3', '--cluster', '6',
                            '--cut', 'voronoi:20', '--cluster', '2:evenness=0.8', '--cut',
                            'voronoi:4')
        counts = [line.split()[1] for line in made.stdout.splitlines()
                  if re.match(r'^ +[1-9] ', line)]
        self.assertEqual(counts, ['3', '6', '20', '40', '80'])
        self.assertIn('cluster', made.stdout)
        self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))
        for levels in (['--cut', 'voronoi:9', '--cluster', '3'],
                       ['--cluster', '3:evenness=2', '--cut', 'voronoi:9'], ['--cluster', '3']):
            wrong = self.run_bake('bake', self.model, '-o', self.out, *levels)
            self.assertNotEqual(wrong.returncode, 0)
            self.assertRegex(wrong.stderr, 'finer level|0 to 1|no fracture line')

    def test_quiet_says_nothing(self):
        result = self.bake('--quiet')
        self.assertEqual(result.stdout + result.stderr, '')
        self.assertTrue(self.out.exists())

    def on_a_terminal(self, *arguments):
        """The command with stderr on a terminal: its result, and what the terminal received."""
        ours, theirs = pty.openpty()
        try:
            result = self.run_bake(*arguments, stderr=theirs)
            os.close(theirs)
            shown = b''
            while True:
                try:
                    more = os.read(ours, 4096)
                except OSError:  # how Linux says that the other side has closed
                    break
                if not more:
                    break
                shown += more
        finally:
            os.close(ours)
        return result, shown.decode()

    def test_progress_goes_to_the_terminal_and_the_table_to_standard_output(self):
        arguments = ['bake', self.model, '-o', self.out, '--map', self.map]
        result, shown = self.on_a_terminal(*arguments)
        self.assertEqual(result.returncode, 0)
        self.assertRegex(shown, r'0 %  reading')
        self.assertRegex(shown, r'\d+ %  cutting')
        self.assertTrue(shown.endswith('\r\033[K'), repr(shown))
        self.assertTrue(result.stdout.startswith('object '))
        self.assertNotIn('\033', result.stdout)
        self.assertEqual(self.on_a_terminal(*arguments, '--quiet')[1], '')

    def test_an_error_on_a_terminal_replaces_the_progress(self):
        result, shown = self.on_a_terminal('bake', self.model, '-o', self.out, '--map', 'gone.svg')
        self.assertEqual(result.returncode, EXIT['FileNotFound'])
        self.assertIn('\r\033[Ksherd-bake: gone.svg', shown)

    def test_a_model_may_be_baked_over_itself_again_and_again(self):
        self.bake()
        for _ in range(2):
            self.bake(out=self.model)
            self.assertEqual(self.model.read_bytes(), self.out.read_bytes())
        self.succeed('check', self.model)

    def test_an_older_output_is_replaced(self):
        self.out.write_bytes(b'an older bake')
        self.bake()
        self.succeed('check', self.out)

    def test_the_source_is_left_as_it_was(self):
        before = self.model.read_bytes()
        self.bake()
        self.assertEqual(self.model.read_bytes(), before)

    def test_equal_inputs_give_equal_bytes_whatever_the_thread_count(self):
        self.bake()
        for threads in ([], ['--threads', '1'], ['--threads', '7']):
            again = self.dir / 'again.glb'
            self.bake(*threads, out=again)
            self.assertEqual(again.read_bytes(), self.out.read_bytes(), threads)

    def test_two_map_files_are_two_levels(self):
        halves = self.write('halves.svg', inputs.halves_svg())
        disc = self.write('disc.svg', inputs.disc_svg())
        self.bake()
        second = self.dir / 'second.glb'
        self.succeed('bake', self.model, '--map', halves, '--map', disc, '-o', second)
        self.assertEqual(second.read_bytes(), self.out.read_bytes())

    def test_a_json_map_cuts_like_a_drawing(self):
        square = self.write('square.json', inputs.square_json_map())
        self.succeed('bake', self.model, '--map', square, '-o', self.out)
        self.succeed('check', self.out)

    def test_a_recipe_names_its_maps_relative_to_itself(self):
        self.write('recipes/map.svg', inputs.two_level_svg())
        recipe = self.write('recipes/cube.json', b'{"levels": [{"map": "map.svg"}]}')
        self.succeed('bake', self.model, '--recipe', recipe, '-o', self.out)
        self.bake(out=self.dir / 'again.glb')
        self.assertEqual((self.dir / 'again.glb').read_bytes(), self.out.read_bytes())

    def test_the_report_tells_levels_findings_and_stages(self):
        report = self.dir / 'report.json'
        self.bake('--report', report)
        told = json.loads(report.read_text())
        self.assertEqual(told['source'], str(self.model))
        cube, = told['objects']
        self.assertEqual(cube['name'], 'cube')
        self.assertEqual(cube['triangles'], 192)
        self.assertEqual(cube['boundaryEdges'], 0)
        self.assertAlmostEqual(cube['volume'], 1, 9)
        self.assertAlmostEqual(cube['diagonal'], 3 ** 0.5, 6)
        self.assertEqual([level['fragments'] for level in cube['levels']], [1, 2, 3])
        self.assertEqual([level['components'] for level in cube['levels']], [1, 2, 3])
        self.assertEqual([level['closed'] for level in cube['levels']], [1, 2, 3])
        for level in cube['levels']:
            self.assertGreater(level['volumeShare'], 0.98)
            self.assertLess(level['volumeShare'], 1.0001)
        self.assertIsInstance(cube['findings'], list)
        self.assertTrue(all(stage['seconds'] >= 0 for stage in cube['stages']))

    def test_measures_come_with_a_report_or_when_asked_for(self):
        report = self.dir / 'report.json'
        plain = self.bake().stdout.splitlines()[0].split()
        asked = self.bake('--measure').stdout.splitlines()[0].split()
        reported = self.bake('--report', report).stdout.splitlines()[0].split()
        self.assertEqual(asked, plain + ['none', 'double', 'outside', 'crossings', 'thinnest',
                                         'hulls', 'filled', 'overlap'])
        self.assertEqual(reported, asked)
        cube, = json.loads(report.read_text())['objects']
        for level in cube['levels'] + cube['fragments']:
            self.assertGreaterEqual(level['selfIntersections'], 0)
            self.assertLess(level['protrusion'], 1e-5)
            self.assertGreater(level['thinnest'], 0)
            self.assertLess(level['thinnest'], 1.01)
        self.assertEqual(cube['levels'][0]['coverage'], {'none': 0, 'double': 0})
        self.assertEqual(cube['levels'][0]['selfIntersections'], 0)
        self.assertEqual(len(cube['fragments']), 5)
        self.assertEqual([f['level'] for f in cube['fragments']], [0, 1, 1, 2, 2])
        self.assertAlmostEqual(cube['fragments'][1]['volume'] + cube['fragments'][2]['volume'],
                               cube['levels'][1]['volumeShare'], 6)
        recipe = self.write('fast.json', b'{"levels": [{"map": "map.svg"}], "measure": false}')
        self.succeed('bake', self.model, '--recipe', recipe, '-o', self.out, '--report', report)
        cube, = json.loads(report.read_text())['objects']
        self.assertNotIn('coverage', cube['levels'][1])
        self.assertGreater(cube['levels'][1]['hiddenShare'], 0)

    def test_what_is_degraded_is_told_in_table_and_report(self):
        # A line that ends inside the chart separates nothing; beside a disc it is a finding.
        loose = self.write('loose.svg', inputs.svg(
            inputs.DISC + '<path d="M0.3 0.5 L0.4 0.5"/><text>here</text>'))
        result = self.succeed('bake', self.model, '--map', loose, '-o', self.out, '--report',
                              self.dir / 'report.json')
        self.assertIn('text', result.stdout)
        findings = json.loads((self.dir / 'report.json').read_text())['objects'][0]['findings']
        self.assertTrue(any('text' in f['message'] for f in findings), findings)

    def test_every_exported_piece_is_closed_and_named_by_level(self):
        self.bake()
        pieces = self.dir / 'new' / 'pieces'
        result = self.succeed('export', self.out, '-o', pieces)
        self.assertEqual(result.stderr, '')
        self.assertEqual(result.stdout, f'6 files in {pieces}\n')
        self.assertEqual(names(pieces), TWO_LEVELS)
        for path in pieces.iterdir():
            self.assertEqual(obj_check.why_not_closed(path), '', path.name)
            self.assertGreater(obj_check.volume(path), 0, path.name)

    def test_levels_fill_the_object(self):
        self.bake()
        self.succeed('export', self.out, '-o', self.dir / 'pieces')
        for level in range(3):
            total = sum(obj_check.volume(p)
                        for p in (self.dir / 'pieces').glob(f'level{level}_*.obj'))
            self.assertAlmostEqual(total, 1, 2)
        self.assertAlmostEqual(obj_check.volume(self.dir / 'pieces/level0_fragment0.obj'), 1, 6)

    def test_the_medial_surface_alone_bounds_what_the_pieces_leave_out(self):
        self.bake()
        self.succeed('export', self.out, '-o', self.dir / 'pieces')
        self.succeed('export', self.out, '-o', self.dir / 'medial', '--medial')
        self.assertEqual(names(self.dir / 'medial'), ['medial.obj'])
        medial = self.dir / 'medial' / 'medial.obj'
        self.assertEqual(obj_check.why_not_closed(medial), '')
        pieces = sum(obj_check.volume(p) for p in (self.dir / 'pieces').glob('level1_*.obj'))
        self.assertAlmostEqual(1 - pieces, obj_check.volume(medial), 6)

    def test_the_object_itself_keeps_its_corners(self):
        self.bake()
        self.succeed('export', self.out, '-o', self.dir / 'pieces')
        positions, _ = obj_check.read_obj(self.dir / 'pieces/level0_fragment0.obj')
        self.assertEqual(len(set(positions)), len(positions))
        for corner in inputs.cube_mesh().positions:
            self.assertIn(tuple('%.9g' % x for x in corner), positions)

    def test_an_undivided_piece_is_repeated_at_the_deeper_level(self):
        self.bake()
        self.succeed('export', self.out, '-o', self.dir / 'pieces')
        level = [[p.read_bytes() for p in sorted((self.dir / 'pieces').glob(f'level{k}_*'))]
                 for k in range(3)]
        self.assertEqual(len(set(level[1]) & set(level[2])), 1)

    def test_exporting_twice_gives_the_same_files(self):
        self.bake()
        for folder in ('a', 'b', 'b'):
            self.succeed('export', self.out, '-o', self.dir / folder)
        for name in TWO_LEVELS:
            self.assertEqual((self.dir / 'a' / name).read_bytes(),
                             (self.dir / 'b' / name).read_bytes())

    def test_several_objects_have_a_folder_each(self):
        two = self.write('two.glb', inputs.two_cubes_glb())
        self.bake(model=two)
        self.succeed('check', self.out)
        pieces = self.dir / 'pieces'
        self.succeed('export', self.out, '-o', pieces)
        self.assertEqual(names(pieces), [f'{o}/{n}' for o in ('left', 'right_one')
                                         for n in TWO_LEVELS])
        for path in pieces.rglob('*.obj'):
            self.assertEqual(obj_check.why_not_closed(path), '', path)

    def test_one_node_of_several_can_be_baked_alone(self):
        two = self.write('two.glb', inputs.two_cubes_glb())
        for node in ('right/one', '1'):
            result = self.bake('--node', node, model=two)
            self.assertIn('right/one', result.stdout)
            self.assertNotIn('left', result.stdout)
            self.succeed('export', self.out, '-o', self.dir / 'pieces')
            self.assertEqual(names(self.dir / 'pieces'), TWO_LEVELS)

    def test_an_obj_is_baked_into_a_glb_of_its_own(self):
        obj = self.write('cube.obj', inputs.model_obj())
        self.bake(model=obj)
        self.succeed('check', self.out)
        document, _ = inputs.unpack_glb(self.out.read_bytes())
        self.assertEqual(document['extensionsUsed'], ['SHERD_mesh_fracture'])

    def test_an_open_mesh_is_baked_when_asked_for(self):
        model = self.write('open.glb', inputs.model_glb(inputs.open_cube_mesh()))
        result = self.bake('--allow-open', model=model)
        self.assertIn('open-mesh', result.stdout)
        self.succeed('check', self.out)

    def test_the_extension_is_used_but_never_required(self):
        self.bake()
        document, _ = inputs.unpack_glb(self.out.read_bytes())
        self.assertIn('SHERD_mesh_fracture', document['extensionsUsed'])
        self.assertNotIn('extensionsRequired', document)
        source, _ = inputs.unpack_glb(self.model.read_bytes())
        for key in ('meshes', 'scenes', 'images', 'textures', 'samplers'):
            self.assertEqual(document[key], source[key], key)

    def test_every_command_shows_examples(self):
        for command in ('bake', 'layout', 'check', 'export'):
            result = self.succeed(command, '--help')
            self.assertIn('Example', result.stdout, command)
            self.assertIn(f'sherd-bake {command}', result.stdout)
            self.assertEqual(result.stderr, '')
        whole = self.succeed('--help').stdout
        for code in EXIT.values():
            self.assertRegex(whole, rf'\b{code} ')
        self.assertRegex(self.succeed('--version').stdout, r'^\d+\.\d+\.\d+\n$')


class TheClosedChecker(CommandCase):
    """The judge of the tests above is itself judged."""

    def test_it_accepts_a_cube_and_refuses_each_way_of_breaking_it(self):
        whole = inputs.model_obj().decode().splitlines()
        path = self.write('cube.obj', inputs.model_obj())
        self.assertEqual(obj_check.why_not_closed(path), '')
        self.assertAlmostEqual(obj_check.volume(path), 1, 6)
        last = whole[-1].split()
        broken = {
            'a missing face': whole[:-1],
            'a doubled face': whole + [whole[-1]],
            'a flipped face': whole[:-1] + [' '.join([last[0], last[1], last[3], last[2]])],
            'a moved corner, one digit': [whole[0] + '1'] + whole[:0] + whole[1:],
            'no faces': [line for line in whole if not line.startswith('f')],
            'a face without area': whole + [' '.join(['f', last[1], last[2], last[1]])],
        }
        # A corner that moves moves all its faces: what breaks a mesh is a second place beside it.
        count = sum(line.startswith('v ') for line in whole)
        split = [line for line in whole if line.startswith('v ')] + [whole[0] + '1']
        split += [line for line in whole if line.startswith('vt')]
        faces = [line for line in whole if line.startswith('f')]
        first = next(i for i, f in enumerate(faces) if ' 1/' in f)
        faces[first] = faces[first].replace(' 1/', f' {count + 1}/')
        broken['a moved corner, one digit'] = split + faces
        for name, lines in broken.items():
            path.write_text('\n'.join(lines) + '\n')
            self.assertNotEqual(obj_check.why_not_closed(path), '', name)


if __name__ == '__main__':
    unittest.main()
