# SPDX-License-Identifier: MIT
"""Which nodes of a scene are one object: seen in several places, or joined from several parts."""
import json
import unittest

import inputs
from command_case import CommandCase

EXTENSION = 'SHERD_mesh_fracture'


class Objects(CommandCase):
    def setUp(self):
        super().setUp()
        self.map = self.write('halves.svg', inputs.halves_svg())
        self.out = self.dir / 'out.glb'

    def bake(self, model, *extra):
        """The baked document and the report's objects; the file has passed the check."""
        report = self.dir / 'report.json'
        self.succeed('bake', model, '--map', self.map, '-o', self.out, '--report', report, *extra)
        self.succeed('check', self.out)
        document, _ = inputs.unpack_glb(self.out.read_bytes())
        return document, json.loads(report.read_text())['objects']

    def carriers(self, document):
        return {i: node['extensions'][EXTENSION]['fracture']
                for i, node in enumerate(document['nodes']) if 'extensions' in node}

    def test_two_nodes_of_one_mesh_are_baked_once_and_both_carry_the_set(self):
        model = self.write('twice.glb', inputs.two_sights_glb())
        document, objects = self.bake(model)
        self.assertEqual(len(objects), 1)
        self.assertEqual(self.carriers(document), {0: 0, 1: 0})
        self.assertEqual(len(document['extensions'][EXTENSION]['fractures']), 1)

    def test_another_scale_is_another_object(self):
        model = self.write('scaled.glb', inputs.two_sights_glb(scale=2))
        document, objects = self.bake(model)
        self.assertEqual(len(objects), 2)
        self.assertEqual(self.carriers(document), {0: 0, 1: 1})

    def test_joined_nodes_are_one_object_hung_on_the_first(self):
        model = self.write('two.glb', inputs.two_cubes_glb())
        apart, objects = self.bake(model)
        self.assertEqual(self.carriers(apart), {0: 0, 1: 1})
        self.assertEqual([o['name'] for o in objects], ['left', 'right/one'])
        joined, objects = self.bake(model, '--join')
        self.assertEqual([o['name'] for o in objects], ['left'])
        self.assertEqual(self.carriers(joined), {0: 0})
        fracture, = joined['extensions'][EXTENSION]['fractures']
        self.assertEqual(fracture['joined'], [1])
        self.assertEqual(objects[0]['parts'], 2)
        self.assertEqual(objects[0]['levels'][1]['components'], 4)

    def test_a_joined_part_that_changed_makes_the_bake_stale(self):
        self.bake(self.write('two.glb', inputs.two_cubes_glb()), '--join')
        document, binary = inputs.unpack_glb(self.out.read_bytes())
        accessor = document['meshes'][1]['primitives'][0]['attributes']['POSITION']
        view = document['bufferViews'][document['accessors'][accessor]['bufferView']]
        binary = bytearray(binary)
        binary[view['byteOffset'] + 1] ^= 1
        stale = self.write('stale.glb', inputs.pack_glb(document, bytes(binary)))
        result = self.run_bake('check', stale)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn('stale', result.stdout + result.stderr)

    def test_the_layout_of_joined_nodes_is_one(self):
        model = self.write('two.glb', inputs.two_cubes_glb())
        self.succeed('layout', model, '-o', self.dir / 'apart.svg')
        self.succeed('layout', model, '-o', self.dir / 'joined.svg', '--join')


if __name__ == '__main__':
    unittest.main()
