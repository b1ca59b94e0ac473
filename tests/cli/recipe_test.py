# SPDX-License-Identifier: MIT
"""Examples of recipes and their schema, held against what a bake takes."""
import json
import re
import unittest

import inputs
from command_case import CommandCase, EXIT

try:
    import jsonschema
except ImportError:
    jsonschema = None


def without_comments(text):
    return re.sub(r'//.*', '', text)  # no string of an example has //


def places(schema, path=()):
    """Every value that the schema speaks of: its path (0 in lists, 'x' for keys that are names) and
    what the schema says of it. Points are values."""
    yield path, schema
    for choice in schema.get('anyOf', []):
        yield from places(choice, path)
    for key, below in schema.get('properties', {}).items():
        yield from places(below, path + (key,))
    if isinstance(schema.get('additionalProperties'), dict):
        yield from places(schema['additionalProperties'], path + ('x',))
    if 'items' in schema and 'maxItems' not in schema:
        yield from places(schema['items'], path + (0,))


def recipe_with(path, value):
    for step in reversed(path):
        value = [value] if step == 0 else {step: value}
    return value


def pointer(path):
    return '#' + ''.join(f'/{step}' for step in path)


class Recipes(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.textured_cube_glb())
        self.out = self.dir / 'out.glb'
        self.schema = json.loads(self.succeed('recipe', '--schema').stdout)

    def names(self):
        listed = self.succeed('recipe').stdout.splitlines()[1:]
        return [line.split(':')[0].strip() for line in listed]

    def refusal(self, recipe):
        path = self.write('r.json', json.dumps(recipe).encode())
        result = self.run_bake('bake', self.model, '-o', self.out, '--recipe', path)
        self.assertEqual(result.returncode, EXIT['InvalidData'], result.stderr)
        return result.stderr

    def test_every_example_follows_the_schema_and_those_without_drawings_bake(self):
        self.assertIn('wall', self.names())
        for name in self.names():
            text = self.succeed('recipe', '--example', name).stdout
            recipe = json.loads(without_comments(text))
            if jsonschema:
                jsonschema.validate(recipe, self.schema)
            if any('map' in level for level in recipe['levels']):
                continue
            path = self.write(name + '.json', text.encode())
            self.succeed('bake', self.model, '-o', self.out, '--recipe', path)
            self.assertTrue(self.succeed('check', self.out).stdout.endswith('check passed\n'))

    def test_the_schema_has_the_keys_that_a_bake_knows(self):
        for path, schema in places(self.schema):
            if 'properties' not in schema:
                continue
            said = self.refusal(recipe_with(path, {'no such key': 1}))
            known = re.search(r'known are ([\w$, ]+)', said).group(1).split(', ')
            self.assertEqual(set(known), set(schema['properties']), path)
            self.assertIn(pointer(path + ('no such key',)), said)

    def test_bounds_of_the_schema_are_those_of_a_bake(self):
        for path, bounds in places(self.schema):
            if 'maximum' not in bounds:
                continue
            for beyond in (bounds['minimum'] - 1 - abs(bounds['minimum']), bounds['maximum'] * 2 + 1):
                said = self.refusal(recipe_with(path, beyond))
                self.assertIn(pointer(path), said)
                numbers_said = re.search(r'from (\S+) to (\S+)', said)
                self.assertEqual(float(numbers_said.group(1)), bounds['minimum'], said)
                self.assertEqual(float(numbers_said.group(2)), bounds['maximum'], said)

    @unittest.skipUnless(jsonschema, 'python3-jsonschema is missing')
    def test_a_bake_takes_what_the_schema_takes_and_tells_where_it_does_not(self):
        validator = jsonschema.Draft7Validator(self.schema)
        samples = [None, True, -7, 3.5, 2.0, 1e30, '', 'no such word', [], {}, [1], [1, 2, 3],
                   ['x', 'y', 'z'], {'no such key': 1}]
        told = 0
        for path, schema in places(self.schema):
            for sample in samples:
                recipe = recipe_with(path, sample)
                file = self.write('r.json', json.dumps(recipe).encode())
                # The recipe is read before the model, which is not there.
                result = self.run_bake('bake', 'missing.glb', '-o', self.out, '--recipe', file)
                if validator.is_valid(recipe):
                    self.assertEqual(result.returncode, EXIT['FileNotFound'],
                                     f'{recipe}\n{result.stderr}')
                    continue
                self.assertEqual(result.returncode, EXIT['InvalidData'], f'{recipe}\n{result.stderr}')
                said = result.stderr
                here = jsonschema.Draft7Validator(schema).is_valid(sample)
                where = re.search(r'r\.json(#\S*)', said).group(1)
                self.assertTrue(pointer(path).startswith(where.rstrip(',:')) or here or
                                where.startswith(pointer(path)), f'{recipe}\n{said}')
                if here or pointer(path) not in said:
                    continue
                for word in schema.get('enum', []):
                    self.assertIn(word, said)
                if schema.get('type') == 'boolean':
                    self.assertRegex(said, 'must be true(,| or) false')
                told += 1
        self.assertGreater(told, 300)

    def test_counts_and_choices_that_cannot_be_are_refused_with_what_can(self):
        for recipe, where, mention in [
                ({'levels': [{'cut': 'voronoi:0'}]}, '#/levels/0/cut', '1 to'),
                ({'levels': [{'cut': 'voronoi:8'}, {'cut': 'slices:0x2x2'}]}, '#/levels/1/cut', '1 to'),
                ({'levels': [{'cut': 'voronoi:8:larger=2'}]}, '#/levels/0/cut', '0 to 1'),
                ({'levels': [{'cut': 'voronoi:8', 'map': 'a.svg'}]}, '#/levels/0', 'needs one of'),
                ({'levels': [{'pattern': 'voronoi:0'}]}, '#/levels/0/pattern', 'to'),
                ({'levels': [{'map': 'a.svg', 'projection': 'sphere'}]},
                 '#/levels/0/projection', 'cylindrical'),
                ({'anchors': [{}]}, '#/anchors/0', '"below"'),
                ({'anchors': [{'below': 0, 'label': 'a'}]}, '#/anchors/0', 'needs one of'),
                ({'anchors': [{'below': {'normal': [0, 1, 0]}}]}, '#/anchors/0/below', '"point"'),
                ({'anchors': [{'below': {'point': [0, 0, 0], 'normal': [0, 0, 0]}}]},
                 '#/anchors/0/below/normal', 'zero'),
                ({'anchors': [{'box': {'min': [0, 0, 0], 'max': [1, -1, 1]}}]},
                 '#/anchors/0/box/max', 'at least'),
                ({'materials': {'a/b~c': 3}}, '#/materials/a~1b~0c', 'object')]:
            said = self.refusal(recipe)
            self.assertIn(where + ': ', said)
            self.assertIn(mention, said)

    def test_an_example_that_is_not_there_is_answered_by_those_that_are(self):
        result = self.run_bake('recipe', '--example', 'cheese')
        self.assertEqual(result.returncode, EXIT['BadArgument'])
        self.assertIn('wall', result.stderr)


if __name__ == '__main__':
    unittest.main()
