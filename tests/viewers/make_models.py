# SPDX-License-Identifier: MIT
"""make_models.py SHERD_BAKE DIR [MODEL MAP...]: a source model and its bake, for viewers to compare.
Without a model: a textured cube, a file of two cubes, and a cube with all that hidden faces can have."""
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / 'cli'))
import inputs  # noqa: E402


def bake(program, source, maps, *extra):
    baked = source.with_name(source.stem + '_baked.glb')
    arguments = [program, 'bake', source, '-o', baked, '--quiet', *extra]
    for path in maps:
        arguments += ['--map', path]
    subprocess.run(list(map(str, arguments)), check=True)


def main():
    program, folder, *given = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    if given:
        source = folder / pathlib.Path(given[0]).name
        shutil.copyfile(given[0], source)
        bake(program, source, given[1:])
        return
    drawing = folder / 'map.svg'
    drawing.write_bytes(inputs.two_level_svg())
    for name, data in (('cube', inputs.textured_cube_glb()), ('two_cubes', inputs.two_cubes_glb())):
        source = folder / f'{name}.glb'
        source.write_bytes(data)
        bake(program, source, [drawing])
    source = folder / 'detailed_cube.glb'
    source.write_bytes(inputs.detailed_cube_glb())
    recipe = folder / 'looks.json'
    recipe.write_bytes(inputs.looks_recipe())
    bake(program, source, [drawing], '--recipe', recipe)


main()
