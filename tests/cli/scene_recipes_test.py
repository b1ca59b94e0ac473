# SPDX-License-Identifier: MIT
"""Scenes whose nodes carry their recipes (extras.sherd), and scenes in other units than metres."""
import json
import unittest

import inputs
from command_case import CommandCase

EXTENSION = 'SHERD_mesh_fracture'
HALVES = {'levels': [{'cut': 'slices:1x2x1'}]}
QUARTERS = {'levels': [{'cut': 'slices:2x1x2', 'name': 'quarters'}]}


scene = inputs.cubes_with_recipes_glb
same_mesh = inputs.one_cube_with_recipes_glb


class SceneRecipes(CommandCase):
    def setUp(self):
        super().setUp()
        self.out = self.dir / 'out.glb'

    def bake(self, data, *extra):
        """The baked document and the report's objects; the file has passed the check."""
        model = self.write('scene.glb', data)
        report = self.dir / 'report.json'
        self.succeed('bake', model, '-o', self.out, '--report', report, *extra)
        self.succeed('check', self.out)
        document, _ = inputs.unpack_glb(self.out.read_bytes())
        return document, json.loads(report.read_text())['objects']

    def refusal(self, value, code, mentions):
        model = self.write('scene.glb', scene([None, value]))
        self.refuse(['bake', model, '-o', self.out], code, ['scene.glb#/nodes/1/extras/sherd',
                                                            *mentions])

    def carriers(self, document):
        return {i: node['extensions'][EXTENSION]['fracture']
                for i, node in enumerate(document['nodes']) if 'extensions' in node}

    def counts(self, objects):
        return [o['levels'][-1]['fragments'] for o in objects]

    def findings(self, objects):
        return ' '.join(f['message'] for o in objects for f in o['findings'])

    def test_each_node_breaks_by_its_own_recipe_and_the_rest_stays_whole(self):
        self.write('recipes/quarters.json', json.dumps(QUARTERS).encode())
        data = scene([HALVES, None, 'recipes/quarters.json',
                      '// as text\n' + json.dumps({'levels': [{'cut': 'voronoi:3'}]})])
        document, objects = self.bake(data)
        self.assertEqual(self.counts(objects), [2, 4, 3])
        self.assertEqual(self.carriers(document), {0: 0, 2: 1, 3: 2})
        self.assertIn('left whole, having no recipe: node "cube 1"', self.findings(objects))
        before, _ = inputs.unpack_glb(data)
        for old, new in zip(before['nodes'], document['nodes']):
            self.assertEqual(old['extras'] if 'extras' in old else None, new.get('extras'))

    def test_the_mesh_may_carry_the_recipe_and_the_node_knows_better(self):
        document, binary = inputs.unpack_glb(scene([HALVES, HALVES], 'meshes'))
        document['nodes'][1]['extras'] = {'sherd': QUARTERS}
        _, objects = self.bake(inputs.pack_glb(document, binary))
        self.assertEqual(self.counts(objects), [2, 4])

    def test_nodes_of_one_mesh_share_a_bake_only_if_they_share_the_recipe(self):
        document, objects = self.bake(same_mesh([HALVES, QUARTERS, HALVES, QUARTERS, None]))
        self.assertEqual(self.counts(objects), [2, 4])
        self.assertEqual(self.carriers(document), {0: 0, 1: 1, 2: 0, 3: 1})
        self.assertIn('by another recipe', self.findings(objects))

    def test_options_win_over_nodes_and_lines_on_the_command_line_break_all(self):
        data = scene([HALVES, None])
        _, objects = self.bake(data, '--density', '500')
        self.assertEqual(self.counts(objects), [2])
        _, objects = self.bake(data, '--cut', 'slices:3x1x1')
        self.assertEqual(self.counts(objects), [3, 3])
        # One recipe for all is asked for by name, and what nodes bring is not even looked at.
        recipe = self.write('all.json', json.dumps(QUARTERS).encode())
        _, objects = self.bake(scene([3, None]), '--recipe', recipe)
        self.assertEqual(self.counts(objects), [4, 4])
        self.assertIn('--recipe says how everything breaks', self.findings(objects))

    def test_chosen_nodes_break_by_their_recipes(self):
        _, objects = self.bake(scene([HALVES, QUARTERS, 3]), '--node', 'cube 1')
        self.assertEqual(self.counts(objects), [4])
        model = self.write('scene.glb', scene([HALVES, None]))
        self.refuse(['bake', model, '-o', self.out, '--node', 'cube 1'], 'BadArgument',
                    ['nothing to cut along', 'extras.sherd'])

    def test_joined_nodes_have_one_recipe(self):
        _, objects = self.bake(scene([HALVES, None]), '--join')
        self.assertEqual(self.counts(objects), [2])
        model = self.write('scene.glb', scene([HALVES, QUARTERS]))
        self.refuse(['bake', model, '-o', self.out, '--join'], 'InvalidData',
                    ['#/nodes/1/extras/sherd', '#/nodes/0/extras/sherd', 'different recipes'])

    def test_what_is_no_recipe_is_refused_where_it_stands(self):
        for value in (3, [], True, '', [HALVES]):
            self.refusal(value, 'InvalidData', ['must be a recipe as an object'])
        self.refusal({'levles': []}, 'InvalidData', ['/levles', 'known are', 'levels'])
        self.refusal({'levels': [{'cut': 'voronoi:0'}]}, 'InvalidData', ['/levels/0/cut'])
        self.refusal('{"levels": [', 'Malformed', ['not valid JSON', 'line 1'])
        self.refusal('{"levels": [3]}', 'InvalidData', ['/levels/0'])
        self.refusal({'physics': {}}, 'BadArgument', ['/levels', 'nothing to cut along'])
        self.refusal('{"a": "' + 'x' * 10_000_000 + '"}', 'LimitExceeded', ['1 MiB'])
        self.refusal('x' * 10_000_000, 'LimitExceeded', ['10000000 characters'])
        self.refusal('{"levels": ' + '[' * 100_000, 'Malformed', ['not valid JSON'])
        self.refusal('{"levels": ' + '[' * 100_000 + ']' * 100_000 + '}', 'InvalidData',
                     ['/levels/0'])

    def test_recipes_are_files_below_the_folder_of_the_model(self):
        self.write('folder/inner.json', b'{}')
        self.write('bad.json', b'{"levels": [{"cut": "cheese:3"}]}')
        self.refusal('none.json', 'FileNotFound', ['none.json', 'does not exist'])
        self.refusal('folder', 'FileRead', ['not a file'])
        for outside in ('../recipe.json', 'folder/../../recipe.json', '/etc/passwd', '..'):
            self.refusal(outside, 'InvalidData', ['not in the model\'s folder'])
        self.refusal({'levels': [{'map': '../../secret.svg'}]}, 'InvalidData', ['secret.svg'])
        self.refusal({'interior': {'shell': {'texture': '/etc/passwd'}},
                      'levels': [{'cut': 'voronoi:2'}]}, 'InvalidData', ['/etc/passwd'])
        self.refusal('bad.json', 'InvalidData', ['bad.json#/levels/0/cut', 'voronoi'])

    def test_what_a_recipe_names_is_found_beside_the_model_and_beside_the_recipe(self):
        self.write('art/cracks/halves.svg', inputs.halves_svg())
        self.write('art/recipes/halves.json', b'{"levels": [{"map": "../cracks/halves.svg"}]}')
        model = self.write('art/scene.glb', scene([
            {'levels': [{'map': 'cracks/halves.svg'}]}, '{"levels": [{"map": "cracks/halves.svg"}]}',
            'recipes/halves.json', './recipes/../recipes/halves.json']))
        report = self.dir / 'report.json'
        self.succeed('bake', model, '-o', self.out, '--report', report)
        self.assertEqual(self.counts(json.loads(report.read_text())['objects']), [2, 2, 2, 2])
        # What a bake reads it does not overwrite.
        recipe = self.dir / 'art/recipes/halves.json'
        self.refuse(['bake', model, '-o', self.out, '--report', recipe], 'BadArgument',
                    ['would overwrite an input'])

    def test_a_recipe_on_an_empty_node_is_told(self):
        document, binary = inputs.unpack_glb(scene([HALVES]))
        document['nodes'].append({'name': 'group', 'extras': {'sherd': QUARTERS}})
        document['scenes'][0]['nodes'].append(1)
        _, objects = self.bake(inputs.pack_glb(document, binary))
        self.assertIn('node "group" carries a recipe but shows no mesh', self.findings(objects))

    def test_an_anchor_must_hold_one_of_its_objects(self):
        held = dict(HALVES, anchors=[{'below': 0.1}])
        document, objects = self.bake(same_mesh([held, held]))
        fracture, = document['extensions'][EXTENSION]['fractures']
        self.assertIn('bonds', fracture)
        # One that stands higher is another object, and whatever recipe it is.
        path = self.write('r.json', json.dumps(held).encode())
        for recipe, extra in ((held, ()), (None, ('--recipe', path))):
            raised, binary = inputs.unpack_glb(same_mesh([recipe, recipe, recipe]))
            raised['nodes'][1]['translation'][1] = 0.55
            document, objects = self.bake(inputs.pack_glb(raised, binary), *extra)
            self.assertEqual(self.carriers(document), {0: 0, 1: 1, 2: 0})
            self.assertIn('where anchors hold it otherwise', self.findings(objects))
        floating = dict(HALVES, anchors=[
            {'below': 0.1}, {'box': {'min': [9, 9, 9], 'max': [10, 10, 10]}}])
        model = self.write('scene.glb', scene([None, floating]))
        self.refuse(['bake', model, '-o', self.out], 'BadArgument',
                    ['scene.glb#/nodes/1/extras/sherd/anchors/1', 'holds nothing',
                     'from (2.5, 0, -0.5) to (3.5, 1, 0.5)'])

    def test_a_scene_in_centimetres_becomes_one_in_metres(self):
        data = inputs.centimetre_cube_glb()
        before, _ = inputs.unpack_glb(data)
        recipe = {'unitScale': 0.01, 'levels': HALVES['levels'], 'anchors': [{'below': 0.1}]}
        path = self.write('r.json', json.dumps(recipe).encode())
        baked, objects = self.bake(data, '--recipe', path)
        self.assertAlmostEqual(objects[0]['volume'], 1, 4)
        # What was there stays as it was, below one node more.
        self.assertEqual(baked['nodes'][0]['translation'], [300, 50, 0])
        self.assertEqual(baked['nodes'][1]['scale'], [0.01] * 3)
        self.assertEqual(baked['nodes'][1]['children'], [0])
        self.assertEqual(baked['scenes'][0]['nodes'], [1])
        self.assertEqual(baked['meshes'][0]['primitives'][0]['attributes'],
                         before['meshes'][0]['primitives'][0]['attributes'])
        # Baking the bake again scales nothing twice.
        again, objects = self.bake(self.out.read_bytes(), '--recipe', path)
        self.assertAlmostEqual(objects[0]['volume'], 1, 4)
        self.assertEqual(len(again['nodes']), 2)
        # As option, on a node, and as OBJ.
        _, objects = self.bake(data, '--unit-scale', '0.01', '--cut', 'voronoi:3')
        self.assertAlmostEqual(objects[0]['volume'], 1, 4)
        carrying, binary = inputs.unpack_glb(data)
        carrying['nodes'][0]['extras'] = {'sherd': recipe}
        _, objects = self.bake(inputs.pack_glb(carrying, binary))
        self.assertAlmostEqual(objects[0]['volume'], 1, 4)
        obj = self.write('block.obj', inputs.model_obj(inputs.cube_mesh(2, 100)))
        report = self.dir / 'report.json'
        self.succeed('bake', obj, '-o', self.out, '--report', report, '--recipe',
                     self.write('r.json', json.dumps({**recipe, 'anchors': [{'below': -0.4}]}).encode()))
        self.succeed('check', self.out)
        self.assertAlmostEqual(json.loads(report.read_text())['objects'][0]['volume'], 1, 4)

    def test_a_scene_has_one_unit(self):
        model = self.write('scene.glb', scene([dict(HALVES, unitScale=0.01),
                                               dict(QUARTERS, unitScale=0.1)]))
        self.refuse(['bake', model, '-o', self.out], 'InvalidData',
                    ['#/nodes/1/extras/sherd/unitScale', 'one unit'])


if __name__ == '__main__':
    unittest.main()
