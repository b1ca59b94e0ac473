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


def objects(schema, path=()):
    """The path of every object that the schema describes by its keys, and these keys."""
    if 'properties' in schema:
        yield path, set(schema['properties'])
        for key, below in schema['properties'].items():
            yield from objects(below, path + (key,))
    if 'items' in schema:
        yield from objects(schema['items'], path + (0,))


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
        for path, keys in objects(self.schema):
            recipe = {'no such key': 1}
            for step in reversed(path):
                recipe = [recipe] if step == 0 else {step: recipe}
            said = self.refusal(recipe)
            known = re.search(r'known are ([\w, ]+)', said).group(1).split(', ')
            self.assertEqual(set(known), keys, path)

    def test_bounds_of_the_schema_are_those_of_a_bake(self):
        def numbers(schema, path=()):
            for key, below in schema.get('properties', {}).items():
                if 'maximum' in below:
                    yield path + (key,), below
                yield from numbers(below, path + (key,))
        for path, bounds in numbers(self.schema):
            for beyond in (bounds['minimum'] - 1, bounds['maximum'] * 2 + 1):
                recipe = beyond
                for step in reversed(path):
                    recipe = {step: recipe}
                said = self.refusal(recipe)
                self.assertIn('#/' + '/'.join(path), said)
                numbers_said = re.search(r'from (\S+) to (\S+)', said)
                self.assertEqual(float(numbers_said.group(1)), bounds['minimum'], said)
                self.assertEqual(float(numbers_said.group(2)), bounds['maximum'], said)

    def test_an_example_that_is_not_there_is_answered_by_those_that_are(self):
        result = self.run_bake('recipe', '--example', 'cheese')
        self.assertEqual(result.returncode, EXIT['BadArgument'])
        self.assertIn('wall', result.stderr)


if __name__ == '__main__':
    unittest.main()
