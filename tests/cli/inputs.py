# SPDX-License-Identifier: MIT
"""Tiny models and fracture maps, each named after the one thing it shows or gets wrong."""
import json
import math
import struct
import zlib

GLB_MAGIC, JSON_CHUNK, BIN_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_SHORT = 5126, 5123


class Mesh:
    """Corners with their own texture coordinates; triangles wound counter-clockwise."""

    def __init__(self):
        self.positions, self.uvs, self.normals, self.triangles = [], [], [], []

    def add_grid(self, corners, normal, uv_box, n):
        """A square of n x n quads. corners: bottom left, bottom right, top right, top left as seen
        from outside; uv_box: left, top, right, bottom (v down)."""
        first = len(self.positions)
        left, top, right, bottom = uv_box
        for j in range(n + 1):
            for i in range(n + 1):
                s, t = i / n, j / n
                weights = ((1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t)
                self.positions.append(
                    tuple(sum(w * c[a] for w, c in zip(weights, corners)) for a in range(3)))
                self.uvs.append((left + s * (right - left), bottom + t * (top - bottom)))
                self.normals.append(normal)
        for j in range(n):
            for i in range(n):
                a = first + j * (n + 1) + i
                b, c, d = a + 1, a + n + 2, a + n + 1
                self.triangles += [(a, b, c), (a, c, d)]


def cube_mesh(n=4, size=1.0):
    """A closed cube. Its sides are one strip of charts (v 0.4 to 0.65, seam at u = 0 and 1), so a
    level line all along the strip halves it; top and bottom are charts of their own above."""
    h = size / 2
    ring = [(-h, h), (h, h), (h, -h), (-h, -h)]
    normals = [(0, 0, 1), (1, 0, 0), (0, 0, -1), (-1, 0, 0)]
    mesh = Mesh()
    for s in range(4):
        (x0, z0), (x1, z1) = ring[s], ring[(s + 1) % 4]
        mesh.add_grid([(x0, -h, z0), (x1, -h, z1), (x1, h, z1), (x0, h, z0)], normals[s],
                      (s / 4, 0.4, (s + 1) / 4, 0.65), n)
    mesh.add_grid([(x, h, z) for x, z in ring], (0, 1, 0), (0.05, 0.05, 0.3, 0.3), n)
    mesh.add_grid([(x, -h, z) for x, z in (ring[3], ring[2], ring[1], ring[0])], (0, -1, 0),
                  (0.4, 0.05, 0.65, 0.3), n)
    return mesh


def open_cube_mesh():
    """Defect: the top is missing, so the surface encloses nothing."""
    mesh = cube_mesh()
    mesh.triangles = [t for t in mesh.triangles
                      if not all(mesh.normals[v] == (0, 1, 0) for v in t)]
    return mesh


def non_manifold_cube_mesh():
    """Defect: a fin stands on an inner edge of the top, which three triangles then share."""
    mesh = cube_mesh()
    a, b, _ = next(t for t in mesh.triangles if all(mesh.normals[v] == (0, 1, 0) for v in t))
    mesh.positions.append((0.0, 2.0, 0.0))
    mesh.uvs.append((0.9, 0.9))
    mesh.normals.append((1, 0, 0))
    mesh.triangles.append((a, b, len(mesh.positions) - 1))
    return mesh


def inside_out_cube_mesh():
    """Defect: every triangle is wound clockwise, so the volume is negative."""
    mesh = cube_mesh()
    mesh.triangles = [(a, c, b) for a, b, c in mesh.triangles]
    return mesh


def checker_png(side=16):
    """An 8-bit RGB picture without two equal neighbours, to tell orientation apart."""
    rows = b''
    for y in range(side):
        rows += b'\0' + bytes(v for x in range(side)
                              for v in (15 * x, 15 * y, 200 if (x + y) % 2 else 60))

    def chunk(kind, data):
        body = kind + data
        return struct.pack('>I', len(data)) + body + struct.pack('>I', zlib.crc32(body))

    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', side, side, 8, 2, 0, 0, 0))
            + chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


class _Document:
    def __init__(self):
        self.bin = bytearray()
        self.json = {'asset': {'version': '2.0', 'generator': 'sherd tests'}, 'scene': 0,
                     'scenes': [{'nodes': []}], 'nodes': [], 'meshes': [], 'accessors': [],
                     'bufferViews': [], 'buffers': [{}]}

    def view(self, data, target=None):
        while len(self.bin) % 4:
            self.bin.append(0)
        view = {'buffer': 0, 'byteOffset': len(self.bin), 'byteLength': len(data)}
        if target:
            view['target'] = target
        self.bin += data
        self.json['bufferViews'].append(view)
        return len(self.json['bufferViews']) - 1

    def accessor(self, rows, kind, component=FLOAT, bounds=False, target=34962):
        flat = [v for row in rows for v in row]
        code = {FLOAT: 'f', UNSIGNED_SHORT: 'H'}[component]
        accessor = {'bufferView': self.view(struct.pack(f'<{len(flat)}{code}', *flat), target),
                    'componentType': component, 'type': kind,
                    'count': len(rows) if kind != 'SCALAR' else len(flat)}
        if bounds:
            stored = [struct.unpack('<3f', struct.pack('<3f', *row)) for row in rows]
            accessor['min'] = [min(r[a] for r in stored) for a in range(3)]
            accessor['max'] = [max(r[a] for r in stored) for a in range(3)]
        self.json['accessors'].append(accessor)
        return len(self.json['accessors']) - 1

    def add_mesh(self, mesh, name, texcoords=True, translation=None):
        attributes = {'POSITION': self.accessor(mesh.positions, 'VEC3', bounds=True),
                      'NORMAL': self.accessor(mesh.normals, 'VEC3')}
        if texcoords:
            attributes['TEXCOORD_0'] = self.accessor(mesh.uvs, 'VEC2')
        primitive = {'attributes': attributes, 'indices': self.accessor(
            mesh.triangles, 'SCALAR', UNSIGNED_SHORT, target=34963)}
        if 'materials' in self.json:
            primitive['material'] = 0
        self.json['meshes'].append({'name': name, 'primitives': [primitive]})
        node = {'name': name, 'mesh': len(self.json['meshes']) - 1}
        if translation:
            node['translation'] = translation
        self.json['nodes'].append(node)
        self.json['scenes'][0]['nodes'].append(len(self.json['nodes']) - 1)
        return primitive

    def add_texture(self):
        self.json['images'] = [{'bufferView': self.view(checker_png()), 'mimeType': 'image/png'}]
        self.json['samplers'] = [{'magFilter': 9728, 'minFilter': 9728}]
        self.json['textures'] = [{'source': 0, 'sampler': 0}]
        self.json['materials'] = [{'name': 'painted', 'pbrMetallicRoughness': {
            'baseColorTexture': {'index': 0}, 'metallicFactor': 0.0, 'roughnessFactor': 0.8}}]

    def glb(self):
        self.json['buffers'][0]['byteLength'] = len(self.bin)
        return pack_glb(self.json, bytes(self.bin))


def pack_glb(document, binary):
    text = json.dumps(document, separators=(',', ':')).encode()
    text += b' ' * (-len(text) % 4)
    binary += b'\0' * (-len(binary) % 4)
    return (struct.pack('<III', GLB_MAGIC, 2, 28 + len(text) + len(binary))
            + struct.pack('<II', len(text), JSON_CHUNK) + text
            + struct.pack('<II', len(binary), BIN_CHUNK) + binary)


def unpack_glb(data):
    """The document and the binary chunk's bytes."""
    size = struct.unpack_from('<I', data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def model_glb(mesh=None, texcoords=True):
    document = _Document()
    document.add_mesh(mesh or cube_mesh(), 'cube', texcoords)
    return document.glb()


def textured_cube_glb():
    document = _Document()
    document.add_texture()
    document.add_mesh(cube_mesh(), 'cube')
    return document.glb()


def detailed_cube_glb():
    """With tangents, and a material for its inside that nothing outside uses."""
    document = _Document()
    document.add_texture()
    document.json['materials'].append({'name': 'clay', 'pbrMetallicRoughness': {
        'baseColorFactor': [0.6, 0.35, 0.25, 1.0]}})
    mesh = cube_mesh()
    primitive = document.add_mesh(mesh, 'cube')
    across = {(0, 0, 1): (1, 0, 0), (1, 0, 0): (0, 0, -1), (0, 0, -1): (-1, 0, 0),
              (-1, 0, 0): (0, 0, 1), (0, 1, 0): (1, 0, 0), (0, -1, 0): (1, 0, 0)}
    primitive['attributes']['TANGENT'] = document.accessor(
        [across[n] + (1,) for n in mesh.normals], 'VEC4')
    return document.glb()


def two_cubes_glb():
    """Two objects; the second's name is no file name as it stands."""
    document = _Document()
    document.add_mesh(cube_mesh(), 'left')
    document.add_mesh(cube_mesh(6), 'right/one', translation=[3, 0, 0])
    return document.glb()


def two_sights_glb(scale=1):
    """One mesh in two places; the second node may be larger."""
    document = _Document()
    document.add_mesh(cube_mesh(), 'here')
    document.json['nodes'].append({'name': 'there', 'mesh': 0, 'translation': [4, 0, 1],
                                   'rotation': [0, 0.6, 0, 0.8], 'scale': [scale] * 3})
    document.json['scenes'][0]['nodes'].append(1)
    return document.glb()


def cubes_with_recipes_glb(recipes, on='nodes'):
    """Cubes in a row on the ground; the extras.sherd of each one's node (or mesh), None for none."""
    document = _Document()
    for i, recipe in enumerate(recipes):
        document.add_mesh(cube_mesh(2), f'cube {i}', translation=[3 * i, 0.5, 0])
        if recipe is not None:
            document.json[on][i]['extras'] = {'sherd': recipe, 'other': 1}
    return document.glb()


def one_cube_with_recipes_glb(recipes):
    """The same, but all nodes show one mesh."""
    document, binary = unpack_glb(cubes_with_recipes_glb(recipes[:1]))
    for i, recipe in enumerate(recipes[1:], 1):
        node = {'mesh': 0, 'translation': [3 * i, 0.5, 0]}
        if recipe is not None:
            node['extras'] = {'sherd': recipe}
        document['nodes'].append(node)
        document['scenes'][0]['nodes'].append(i)
    return pack_glb(document, binary)


def centimetre_cube_glb():
    """A cube of a metre, in centimetres; it stands on the ground, 3 m from the origin."""
    document = _Document()
    document.add_mesh(cube_mesh(2, 100), 'block', translation=[300, 50, 0])
    return document.glb()


def skinned_cube_glb():
    """Defect: a skin with one joint moves the cube."""
    document = _Document()
    mesh = cube_mesh()
    primitive = document.add_mesh(mesh, 'cube')
    count = len(mesh.positions)
    primitive['attributes']['JOINTS_0'] = document.accessor(
        [(0, 0, 0, 0)] * count, 'VEC4', UNSIGNED_SHORT)
    primitive['attributes']['WEIGHTS_0'] = document.accessor([(1, 0, 0, 0)] * count, 'VEC4')
    document.json['nodes'].append({'name': 'joint'})
    document.json['scenes'][0]['nodes'].append(1)
    document.json['nodes'][0]['skin'] = 0
    document.json['skins'] = [{'joints': [1]}]
    return document.glb()


def morphed_cube_glb():
    """Defect: a morph target, so the cube has no single shape."""
    document = _Document()
    mesh = cube_mesh()
    primitive = document.add_mesh(mesh, 'cube')
    primitive['targets'] = [
        {'POSITION': document.accessor([(0, 0.1, 0)] * len(mesh.positions), 'VEC3', bounds=True)}]
    return document.glb()


def required_extension_glb():
    """Defect: the file says it cannot be understood without an extension nobody has."""
    document, binary = unpack_glb(model_glb())
    document['extensionsUsed'] = document['extensionsRequired'] = ['VENDOR_unheard_of']
    return pack_glb(document, binary)


def out_of_range_index_glb():
    """Defect: one index names a vertex that does not exist."""
    document = _Document()
    mesh = cube_mesh()
    mesh.triangles[7] = (0, 1, 65000)
    document.add_mesh(mesh, 'cube')
    return document.glb()


def no_triangles_glb():
    """Defect: the only primitive is lines."""
    document = _Document()
    document.add_mesh(cube_mesh(), 'cube')['mode'] = 1
    return document.glb()


def missing_buffer_gltf():
    """Defect: the buffer's file is not there."""
    document, binary = unpack_glb(model_glb())
    document['buffers'] = [{'uri': 'gone.bin', 'byteLength': len(binary)}]
    return json.dumps(document).encode()


def model_obj(mesh=None, texcoords=True):
    """Welded positions, so that the mesh is closed as OBJ readers see it."""
    mesh = mesh or cube_mesh()
    number, lines, of_vertex = {}, [], []
    for p in mesh.positions:
        if p not in number:
            number[p] = len(number) + 1
            lines.append('v %.9g %.9g %.9g' % p)
        of_vertex.append(number[p])
    lines += ['vt %.9g %.9g' % (u, 1 - v) for u, v in mesh.uvs]
    for t in mesh.triangles:
        lines.append('f ' + ' '.join(
            f'{of_vertex[v]}/{v + 1}' if texcoords else str(of_vertex[v]) for v in t))
    return ('\n'.join(lines) + '\n').encode()


def svg(content, attributes='viewBox="0 0 1 1"'):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{content}</svg>\n').encode()


LEVEL_LINE = '<path d="M0 0.53 H1"/>'                # halves the cube
DISC = '<circle cx="0.125" cy="0.46" r="0.04"/>'     # cuts a disc out of the upper half


def halves_svg():
    return svg(LEVEL_LINE)


def disc_svg():
    return svg(DISC)


def two_level_svg():
    """Level 1: two halves. Level 2: the upper half loses a disc, the lower stays undivided."""
    layer = '<g xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" ' \
            'inkscape:groupmode="layer" inkscape:label="level %d">%s</g>'
    return svg(layer % (1, LEVEL_LINE) + layer % (2, DISC))


def looks_recipe():
    """Everything that changes how hidden faces look; the maps are the command line's."""
    return json.dumps({'interior': {
        'materials': {'painted': 'clay'}, 'uvMetresPerTile': 0.1, 'creaseAngle': 45,
        'depthColor': 'COLOR_1', 'roughness': {'amplitude': 0.01, 'size': 0.1, 'seed': 3}}}).encode()


def separates_nothing_svg():
    """Defect: a line that ends inside a chart goes round no piece."""
    return svg('<path d="M0.05 0.45 L0.2 0.6"/>')


def empty_svg():
    """Defect: nothing is drawn; what there is cannot be a crack."""
    return svg('<defs><path d="M0 0 H1"/></defs><text x="0" y="0">cracks</text>')


def square_json_map():
    """The same format twice: Sherd's own map, a square in the first side's chart."""
    corners = [[0.05, 0.45], [0.2, 0.45], [0.2, 0.6], [0.05, 0.6], [0.05, 0.45]]
    return json.dumps({'sherdMap': 1, 'lines': [{'points': corners}]}).encode()


def polygon_svg(u, v, radius, corners=6):
    points = ' '.join('%.6f,%.6f' % (u + radius * math.cos(2 * math.pi * k / corners),
                                     v + radius * math.sin(2 * math.pi * k / corners))
                      for k in range(corners))
    return f'<polygon points="{points}"/>'
