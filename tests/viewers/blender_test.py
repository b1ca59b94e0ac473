# SPDX-License-Identifier: MIT
"""blender -b --factory-startup --python-exit-code 3 --python blender_test.py -- SOURCE BAKED ...
What Blender imports from a baked file is what it imports from the source."""
import sys

import bpy
import numpy

# The importer of Blender 3.4 uses a name that numpy 1.24 took away.
if 'bool' not in numpy.__dict__:
    numpy.bool = bool


def describe(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert bpy.ops.import_scene.gltf(filepath=path) == {'FINISHED'}
    objects = []
    for o in sorted(bpy.data.objects, key=lambda o: o.name):
        entry = {'name': o.name, 'type': o.type, 'matrix': [tuple(row) for row in o.matrix_world]}
        if o.type == 'MESH':
            o.data.calc_loop_triangles()
            corners = [tuple(o.matrix_world @ v.co) for v in o.data.vertices]
            entry.update(triangles=len(o.data.loop_triangles), vertices=len(corners),
                         box=(tuple(map(min, zip(*corners))), tuple(map(max, zip(*corners)))),
                         uvs=len(o.data.uv_layers),
                         materials=[m.name for m in o.data.materials])
        objects.append(entry)
    return {'objects': objects, 'scenes': len(bpy.data.scenes),
            'meshes': sorted(m.name for m in bpy.data.meshes),
            'images': [(i.name, tuple(i.size)) for i in bpy.data.images]}


def main():
    files = sys.argv[sys.argv.index('--') + 1:]
    assert files and len(files) % 2 == 0, 'give pairs of SOURCE and BAKED'
    for source, baked in zip(files[::2], files[1::2]):
        expected, found = describe(source), describe(baked)
        meshes = [o for o in expected['objects'] if o['type'] == 'MESH']
        assert meshes and all(o['triangles'] > 0 for o in meshes), source
        assert found == expected, f'{baked}:\n{found}\nbut the source:\n{expected}'
        print(f"{baked}: Blender {bpy.app.version_string} shows {len(meshes)} meshes, "
              f"{sum(o['triangles'] for o in meshes)} triangles, {len(expected['objects'])} objects, "
              'as in the source')


main()
