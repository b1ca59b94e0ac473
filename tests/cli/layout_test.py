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

    def guides(self, svg):
        """The template's layers by name."""
        label = '{http://www.inkscape.org/namespaces/inkscape}label'
        return {g.get(label): g for g in xml.parse(svg).getroot().findall('{*}g')}

    def test_lines_drawn_before_are_shown_over_the_template_and_never_become_cracks(self):
        self.layout()
        drawing = self.draw(level_1=f'<path id="halves" d="M0 {0.53 * SIZE} H{SIZE}"/>'
                                    f'<path id="stub" d="M 100 460 L 150 500"/>')
        look = self.dir / 'look.svg'
        result = self.succeed('layout', self.model, '-o', look, '--lines', drawing)
        for told in ('dead-ends', 'idle-lines', '3 places to look at'):
            self.assertIn(told, result.stdout)
        layers = self.guides(look)
        self.assertEqual(list(layers), ['sherd guide', 'sherd guide lines', 'sherd guide spots',
                                        'sherd guide legend', 'level 1', 'level 2', 'level 3'])
        locked = '{http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd}insensitive'
        for name, layer in layers.items():
            self.assertEqual(layer.get(locked), 'true' if 'guide' in name else None)
        titles = [t.text for t in layers['sherd guide lines'].findall('.//{*}title')]
        self.assertEqual(len(titles), 2)
        self.assertIn('#halves', titles[0])
        self.assertIn('#stub (separates nothing here)', titles[1])
        ends = {(c.get('cx'), c.get('cy')) for c in layers['sherd guide spots'].findall('.//{*}circle')
                if c.find('{*}title').text.startswith('dead-ends')}
        self.assertEqual(ends, {('100.00', '460.00'), ('150.00', '500.00')})
        self.refuse_bake(self.model, [look], 'EmptyMap', ['look.svg', 'guide'])

        self.template = look
        again = self.draw(level_1=f'<path d="M0 {0.53 * SIZE} H{SIZE}"/>')
        self.assertEqual(self.levels(again)[0], [1, 2])

    def test_patterns_projections_and_levels_are_shown_as_they_would_be_baked(self):
        look = self.dir / 'look.svg'
        halves = self.write('halves.svg', inputs.halves_svg())
        self.succeed('layout', self.model, '-o', look, '--lines', halves, '--pattern',
                     'voronoi:9')
        titles = [t.text for t in self.guides(look)['sherd guide lines'].findall('.//{*}title')]
        self.assertTrue(titles[0].startswith('level 1: halves.svg'), titles)
        self.assertTrue(titles[1].startswith('level 2: voronoi:9'), titles)
        self.succeed('layout', self.model, '-o', look, '--lines', halves, '--projection',
                     'planar:z')
        self.assertIn('level 1: halves.svg', look.read_text())

    def test_what_cannot_be_shown_is_refused_and_nothing_written(self):
        look = self.dir / 'look.svg'
        self.refuse(['layout', self.model, '-o', look, '--lines', self.dir / 'no.svg'],
                    'FileNotFound', ['no.svg'])
        self.refuse(['layout', self.model, '-o', look, '--pattern', 'bubbles:3'], 'BadArgument',
                    ['bubbles'])
        halves = self.write('halves.svg', inputs.halves_svg())
        self.refuse(['layout', self.model, '-o', look, '--lines', halves, '--projection', 'odd'],
                    'BadArgument', ['odd'])
        for source in (halves, self.model):
            self.refuse(['layout', self.model, '-o', source, '--force', '--lines', halves],
                        'BadArgument', ['overwrite'])

    def test_chart_borders_are_numbered_in_pairs(self):
        self.assertIn('seam numbers', self.layout().stdout)
        guide = self.guides(self.template)['sherd guide']
        numbers = [t.text for t in guide.findall('.//{*}text')]
        self.assertGreater(len(numbers), 8)
        self.assertTrue(all(numbers.count(n) == 2 for n in numbers), numbers)
        self.layout('--no-seam-labels')
        self.assertNotIn(b'<text', self.template.read_bytes())

    def test_a_model_without_texture_coordinates_has_no_layout(self):
        bare = self.write('bare.glb', inputs.model_glb(texcoords=False))
        self.refuse(['layout', bare, '-o', self.dir / 'x.svg'], 'NoTextureCoordinates',
                    ['bare.glb', 'unwrap'])


if __name__ == '__main__':
    unittest.main()
