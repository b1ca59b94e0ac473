# SPDX-License-Identifier: MIT
"""`check` and `export` on files that are damaged, stale or were never baked."""
import json
import random
import struct
import unittest

import inputs
from command_case import CommandCase, EXIT

COMPONENTS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}


class DamagedFiles(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.model_glb())
        self.map = self.write('map.svg', inputs.two_level_svg())
        self.baked = self.dir / 'out.glb'
        self.succeed('bake', self.model, '--map', self.map, '-o', self.baked, '--quiet')
        self.document, self.binary = inputs.unpack_glb(self.baked.read_bytes())
        self.fracture = self.document['extensions']['SHERD_mesh_fracture']['fractures'][0]

    def place(self, accessor, element=0, component=0):
        """Where in the binary chunk an accessor's number lies."""
        a = self.document['accessors'][accessor]
        view = self.document['bufferViews'][a['bufferView']]
        size = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}[a['componentType']]
        stride = view.get('byteStride', size * COMPONENTS[a['type']])
        return (view.get('byteOffset', 0) + a.get('byteOffset', 0) + element * stride
                + component * size)

    def check_damaged(self, binary=None, document=None):
        path = self.write('damaged.glb', inputs.pack_glb(document or self.document,
                                                         bytes(binary or self.binary)))
        result = self.run_bake('check', path)
        said = f'exit {result.returncode}\n{result.stdout}{result.stderr}'
        self.assertIn(result.returncode, (EXIT['CheckFailed'], EXIT['InvalidData']), said)
        self.assertNotIn('check passed', result.stdout)
        if result.returncode == EXIT['CheckFailed']:
            self.assertIn('check FAILED', result.stdout)
            self.assertRegex(result.stdout, r'FAILED \S+: cube')
        else:
            self.assertEqual(result.stdout, '')
            self.assertIn('damaged.glb', result.stderr)
        return result

    def indices(self):
        return self.fracture['geometry']['indices']

    def positions(self):
        return self.fracture['geometry']['attributes']['POSITION']

    def position_of(self, index):
        at = self.place(self.positions(), index)
        return self.binary[at:at + 12]

    def test_measures_are_told_when_asked_for(self):
        plain = json.loads(self.succeed('check', self.baked, '--json').stdout)
        self.assertNotIn('coverage', plain['objects'][0]['levels'][1])
        self.assertGreater(plain['objects'][0]['levels'][1]['hiddenShare'], 0)
        told = json.loads(self.succeed('check', self.baked, '--json', '--measure').stdout)
        for level in told['objects'][0]['levels']:
            self.assertLess(level['coverage']['none'], 0.05)
            self.assertGreaterEqual(level['selfIntersections'], 0)
            self.assertGreater(level['thinnest'], 0)
        table = self.succeed('check', self.baked, '--measure').stdout
        self.assertRegex(table.splitlines()[0], r'none +double +crossings +thinnest')

    def test_repacking_alone_changes_nothing(self):
        path = self.write('repacked.glb', inputs.pack_glb(self.document, self.binary))
        self.succeed('check', path)

    def index_of(self, element):
        return struct.unpack_from('<I', self.binary, self.place(self.indices(), element))[0]

    def test_every_changed_index_is_noticed(self):
        count = self.document['accessors'][self.indices()]['count']
        vertices = self.document['accessors'][self.positions()]['count']
        tried = 0
        for element in range(0, count, max(1, count // 60)):
            at = self.place(self.indices(), element)
            for byte, flip in ((0, 0x01), (0, 0x80), (1, 0x01), (3, 0x80)):
                damaged = bytearray(self.binary)
                damaged[at + byte] ^= flip
                before, = struct.unpack_from('<I', self.binary, at)
                after, = struct.unpack_from('<I', damaged, at)
                # Another vertex in the same place leaves the same surface.
                if after < vertices and self.position_of(before) == self.position_of(after):
                    continue
                # So does a triangle that was no face, having two corners in one place, and is none.
                corners = [self.index_of(e) for e in range(element // 3 * 3, element // 3 * 3 + 3)]
                changed = list(corners)
                changed[element % 3] = after
                if after < vertices and all(len({self.position_of(v) for v in triangle}) < 3
                                            for triangle in (corners, changed)):
                    continue
                tried += 1
                with self.subTest(element=element, byte=byte, flip=flip):
                    self.check_damaged(damaged)
        self.assertGreater(tried, 150)

    def test_an_index_far_out_of_range_is_refused_with_its_place(self):
        damaged = bytearray(self.binary)
        at = self.place(self.indices(), 4)
        damaged[at:at + 4] = b'\xff' * 4
        self.assertIn('/fractures/0', self.check_damaged(damaged).stderr)

    def test_a_position_that_is_no_number_is_noticed(self):
        damaged = bytearray(self.binary)
        struct.pack_into('<f', damaged, self.place(self.positions(), 3, 1), float('nan'))
        self.check_damaged(damaged)

    def test_a_hidden_point_outside_the_object_is_noticed(self):
        last = self.document['accessors'][self.positions()]['count'] - 1
        damaged = bytearray(self.binary)
        struct.pack_into('<f', damaged, self.place(self.positions(), last, 1), 7.5)
        self.check_damaged(damaged)

    def test_a_wrong_mass_is_noticed(self):
        mass = self.fracture['fragments']['attributes']['MASS']
        damaged = bytearray(self.binary)
        struct.pack_into('<f', damaged, self.place(mass, 1), 1e6)
        self.check_damaged(damaged)

    def assert_found(self, code, accessor, element, component, change):
        """That `check` names `code` once a float of the file is changed."""
        damaged = bytearray(self.binary)
        at = self.place(accessor, element, component)
        before, = struct.unpack_from('<f', damaged, at)
        struct.pack_into('<f', damaged, at, change(before))
        with self.subTest(code=code, element=element, component=component):
            self.assertIn(f'FAILED {code}: ', self.check_damaged(damaged).stdout)

    def test_changed_physics_of_every_fragment_is_noticed(self):
        table = self.fracture['fragments']
        attributes = table['attributes']
        for f in range(table['count']):
            for c in range(3):
                self.assert_found('inertia_wrong', attributes['INERTIA_DIAGONAL'], f, c,
                                  lambda x: 1.05 * x)
                self.assert_found('center_of_mass_wrong', attributes['CENTER_OF_MASS'], f, c,
                                  lambda x: x + 0.05)
        self.assert_found('density_wrong', attributes['DENSITY'], 0, 0, lambda x: 1.1 * x)

    def test_changed_axes_of_inertia_are_noticed(self):
        damaged = bytearray(self.binary)
        orientation = self.fracture['fragments']['attributes']['INERTIA_ORIENTATION']
        count = self.fracture['fragments']['count']
        for f in range(count):
            struct.pack_into('<4f', damaged, self.place(orientation, f), .5, .1, -.7, .5)
        result = self.check_damaged(damaged)
        # Any axes are those of the whole cube.
        self.assertEqual(result.stdout.count('FAILED inertia_wrong: '), count - 1, result.stdout)

    def test_changed_colliders_are_noticed(self):
        hulls = self.fracture['hulls']
        for h in range(hulls['count']):
            self.assert_found('hull_outside', hulls['attributes']['MARGIN'], h, 0,
                              lambda x: x + 0.1)
        points = self.document['accessors'][hulls['points']]['count']
        for point in range(0, points, max(1, points // 20)):
            self.assert_found('hull_outside', hulls['points'], point, 1, lambda x: x + 3)

    def test_changed_bonds_are_noticed(self):
        bonds = self.fracture['bonds']
        # Facing sheets bound what a bond may say; only walls would fix it.
        for b in range(bonds['count']):
            self.assert_found('bond_area', bonds['attributes']['AREA'], b, 0, lambda x: 1e3 * x)
            self.assert_found('bond_centroid', bonds['attributes']['CENTROID'], b, 2,
                              lambda x: x + 2)

    def test_a_changed_normal_is_noticed(self):
        normals = self.fracture['geometry']['attributes']['NORMAL']
        self.assert_found('normal_not_unit', normals, 5, 0, lambda x: x + 1.5)

    def test_a_changed_level_table_is_noticed(self):
        document = json.loads(json.dumps(self.document))
        levels = document['extensions']['SHERD_mesh_fracture']['fractures'][0]['levels']
        levels[-1]['fragmentCount'] += 1
        self.check_damaged(document=document)

    def test_no_flipped_byte_brings_any_command_down(self):
        sane = set(EXIT.values()) - {EXIT['Internal']}
        randomly = random.Random(20130601)
        for name, commands in (('out.glb', (['check'], ['export', '-o', self.dir / 'pieces'])),
                               ('cube.glb', (['bake', '--map', self.map, '-o', self.dir / 'b.glb'],
                                             ['layout', '-o', self.dir / 'l.svg', '--force']))):
            whole = (self.dir / name).read_bytes()
            text = 20 + struct.unpack_from('<I', whole, 12)[0]
            for k in range(40):
                at = randomly.randrange(text if k % 2 else len(whole))
                damaged = bytearray(whole)
                damaged[at] ^= 1 << randomly.randrange(8)
                path = self.write('flipped.glb', bytes(damaged))
                for command in commands:
                    with self.subTest(file=name, at=at, command=command[0]):
                        result = self.run_bake(*command, path)
                        said = f'{damaged[at]}: {result.stdout}{result.stderr}'
                        self.assertIn(result.returncode, sane, said)
                        if result.returncode not in (EXIT['Ok'], EXIT['CheckFailed']):
                            self.assertEqual(result.stdout, '', said)
                            self.assertNotEqual(result.stderr, '', said)

    def test_a_truncated_bake_is_refused_by_check_and_export(self):
        whole = self.baked.read_bytes()
        for length in (0, 3, 19, 200, len(whole) // 2, len(whole) - 1):
            with self.subTest(length=length):
                short = self.write('short.glb', whole[:length])
                self.refuse(['check', short], 'Malformed', ['short.glb'])
                self.refuse(['export', short, '-o', self.dir / 'pieces'], 'Malformed',
                            ['short.glb'])

    def test_the_source_moved_under_its_fragments_is_told(self):
        primitive = self.document['meshes'][0]['primitives'][0]
        damaged = bytearray(self.binary)
        struct.pack_into('<f', damaged, self.place(primitive['attributes']['POSITION'], 0, 0), -.4)
        path = self.write('stale.glb', inputs.pack_glb(self.document, bytes(damaged)))
        result = self.run_bake('check', path)
        self.assertEqual(result.returncode, EXIT['CheckFailed'], result.stdout + result.stderr)
        self.assertIn('bake', result.stdout)

    def test_the_report_as_json_tells_the_same(self):
        told = json.loads(self.succeed('check', self.baked, '--json').stdout)
        self.assertIs(told['passed'], True)
        damaged = bytearray(self.binary)
        damaged[self.place(self.indices(), 0)] ^= 1
        path = self.write('damaged.glb', inputs.pack_glb(self.document, bytes(damaged)))
        result = self.run_bake('check', path, '--json')
        self.assertEqual(result.returncode, EXIT['CheckFailed'])
        self.assertIs(json.loads(result.stdout)['passed'], False)


class OtherFiles(CommandCase):
    def test_a_file_never_baked_is_told_apart_from_a_broken_one(self):
        model = self.write('cube.glb', inputs.model_glb())
        self.refuse(['check', model], 'NoFractureSet', ['cube.glb', 'bake it first'])
        self.refuse(['export', model, '-o', self.dir / 'pieces'], 'NoFractureSet', ['cube.glb'])

    def test_missing_files_and_folders(self):
        for command in (['check'], ['export', '-o', self.dir / 'pieces']):
            self.refuse([*command, self.dir / 'gone.glb'], 'FileNotFound', ['gone.glb'])
            (self.dir / 'folder').mkdir(exist_ok=True)
            self.refuse([*command, self.dir / 'folder'], 'FileRead', ['folder'])

    def test_no_model_at_all(self):
        text = self.write('text.glb', b'this is no model')
        self.refuse(['check', text], 'Malformed', ['text.glb'])
        self.refuse(['export', text, '-o', self.dir / 'pieces'], 'Malformed', ['text.glb'])


class ExportsThatCannotBeWritten(CommandCase):
    def setUp(self):
        super().setUp()
        model = self.write('cube.glb', inputs.model_glb())
        self.baked = self.dir / 'out.glb'
        self.succeed('bake', model, '--map', self.write('map.svg', inputs.two_level_svg()), '-o',
                     self.baked, '--quiet')

    def test_a_file_in_the_place_of_the_folder(self):
        self.write('file', b'a file')
        for folder in ('file', 'file/below'):
            self.refuse(['export', self.baked, '-o', self.dir / folder], 'FileWrite', [folder])

    def test_a_folder_in_the_place_of_one_piece_keeps_all_others_from_being_written(self):
        self.write('pieces/level2_fragment2.obj/kept.txt', b'kept')
        self.refuse(['export', self.baked, '-o', self.dir / 'pieces'], 'FileWrite',
                    ['level2_fragment2.obj', 'in the way'])


if __name__ == '__main__':
    unittest.main()
