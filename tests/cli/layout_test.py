# SPDX-License-Identifier: MIT
"""From the template over a drawing to a bake: the guide must never become cracks."""
import json
import unittest
import xml.etree.ElementTree as xml

import inputs
from command_case import CommandCase

SIZE = 1024  # of the template's page, user units


class DrawingOverTheLayout(CommandCase):
    def setUp(self):
        super().setUp()
        self.model = self.write('cube.glb', inputs.textured_cube_glb())
        self.template = self.dir / 'template.svg'

    def layout(self, *extra):
        return self.succeed('layout', self.model, '-o', self.template, *extra)

    def draw(self, **layers):
        """Inserts text into the layers level_1 to level_3, as an editor would; `end` goes last."""
        text = self.template.read_text()
        for layer, content in layers.items():
            if layer == 'end':
                text = text.replace('</svg>', content + '</svg>')
                continue
            at = text.index('>', text.index(f'<g id="{layer.replace("_", "-")}"')) + 1
            text = text[:at] + content + text[at:]
        return self.write('drawing.svg', text.encode())

    def levels(self, drawing, *extra):
        report = self.dir / 'report.json'
        self.succeed('bake', self.model, '--map', drawing, '-o', self.dir / 'out.glb', '--report',
                     report, *extra)
        self.succeed('check', self.dir / 'out.glb')
        cube, = json.loads(report.read_text())['objects']
        return [level['components'] for level in cube['levels']], cube['findings']

    def test_the_template_is_xml_with_a_locked_guide_the_texture_and_three_layers(self):
        result = self.layout()
        self.assertEqual(result.stderr, '')
        self.assertIn('texture included', result.stdout)
        root = xml.parse(self.template).getroot()
        self.assertEqual(root.get('viewBox'), f'0 0 {SIZE} {SIZE}')
        label = '{http://www.inkscape.org/namespaces/inkscape}label'
        self.assertEqual([g.get(label) for g in root.findall('{*}g')],
                         ['sherd guide', 'level 1', 'level 2', 'level 3'])
        guide = root.find('{*}g')
        locked = '{http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd}insensitive'
        self.assertEqual(guide.get(locked), 'true')
        href = '{http://www.w3.org/1999/xlink}href'
        self.assertTrue(guide.find('{*}image').get(href).startswith('data:image/png;base64,'))

    def test_equal_models_give_equal_templates(self):
        self.layout()
        first = self.template.read_bytes()
        self.layout()
        self.assertEqual(self.template.read_bytes(), first)

    def test_options_of_the_template(self):
        self.assertIn('no texture', self.layout('--no-texture').stdout)
        self.assertNotIn(b'<image', self.template.read_bytes())
        self.layout('--resolution', '512')
        self.assertIn('viewBox="0 0 512 512"', self.template.read_text())
        self.refuse(['layout', self.model, '-o', self.dir / 'x.svg', '--resolution', '4'],
                    'BadArgument', ['16 to 65536'])

    def test_an_untouched_template_is_an_empty_map(self):
        self.layout()
        self.refuse_bake(self.model, [self.template], 'EmptyMap', ['template.svg', 'guide'])

    def test_a_line_in_level_1_cuts_and_the_guide_does_not(self):
        self.layout()
        drawing = self.draw(level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/>')
        plain, _ = self.levels(self.write('plain.svg', inputs.halves_svg()))
        drawn, _ = self.levels(drawing)
        self.assertEqual(drawn, plain)
        self.assertEqual(drawn, [1, 2])

    def test_layers_choose_the_level(self):
        self.layout()
        disc = f'<circle cx="{0.125 * SIZE}" cy="{0.46 * SIZE}" r="{0.04 * SIZE}"/>'
        drawing = self.draw(level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/>', level_2=disc)
        self.assertEqual(self.levels(drawing)[0], [1, 2, 3])

    def test_hidden_things_definitions_and_text_are_passed_over_and_told(self):
        self.layout()
        circle = inputs.polygon_svg(0.625 * SIZE, 0.5 * SIZE, 0.05 * SIZE)
        drawing = self.draw(
            level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/><text x="9" y="9">crack</text>'
                    f'<g style="display:none">{circle}</g><g visibility="hidden">{circle}</g>',
            level_2=f'<g display="none">{circle}</g>',
            end=f'<defs>{circle}</defs>')
        components, findings = self.levels(drawing)
        self.assertEqual(components, [1, 2])
        told = ' '.join(f['message'] for f in findings)
        for word in ('hidden', 'defs', 'text'):
            self.assertIn(word, told)

    def test_a_guide_whose_marks_an_editor_dropped_in_part_stays_a_guide(self):
        self.layout()
        whole = self.draw(level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/>').read_text()
        for kept in ('data-sherd-guide="true"', 'inkscape:label="sherd guide"', 'id="sherd-guide"'):
            text = whole
            for mark in ('data-sherd-guide="true"', 'inkscape:label="sherd guide"',
                         'id="sherd-guide"'):
                if mark != kept:
                    text = text.replace(mark, '')
            with self.subTest(kept=kept):
                drawing = self.write('rewritten.svg', text.encode())
                self.assertEqual(self.levels(drawing)[0], [1, 2])

    def test_a_template_never_replaces_a_drawing_unasked(self):
        self.layout()
        self.layout()  # an untouched one is free
        drawing = self.draw(level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/>')
        self.refuse(['layout', self.model, '-o', drawing], 'FileWrite',
                    ['drawing.svg', '1 fracture line', '--force'])
        self.succeed('layout', self.model, '-o', drawing, '--force')
        self.assertEqual(drawing.read_bytes(), self.template.read_bytes())

    def test_a_model_without_texture_coordinates_has_no_layout(self):
        bare = self.write('bare.glb', inputs.model_glb(texcoords=False))
        self.refuse(['layout', bare, '-o', self.dir / 'x.svg'], 'NoTextureCoordinates',
                    ['bare.glb', 'unwrap'])


if __name__ == '__main__':
    unittest.main()
