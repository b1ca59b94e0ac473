# SPDX-License-Identifier: MIT
"""What the command line tests share: a folder per test, and what a refusal must look like."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BAKE = os.environ.get('SHERD_BAKE', str(SOURCE / 'build/release/bin/sherd-bake'))


def _exit_codes():
    """Read from the header: numbers are documented in one place."""
    codes, at = {}, -1
    text = (SOURCE / 'baker/cli/exit_codes.h').read_text()
    for name, number in re.findall(r'\bkExit(\w+)\s*=\s*(\d+)', text):
        codes[name] = at = int(number)
    assert at > 0
    return codes


EXIT = _exit_codes()


def snapshot(folder):
    """Every path below the folder with its bytes, so that any trace left behind shows."""
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None
            for p in sorted(folder.rglob('*'))}


class CommandCase(unittest.TestCase):
    maxDiff = 2000
    user = None  # run the program as this user

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix='sherd_cli_')
        self.addCleanup(folder.cleanup)
        self.dir = pathlib.Path(folder.name)

    def write(self, name, data):
        path = self.dir / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return path

    def run_bake(self, *arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE):
        return subprocess.run([BAKE, *map(str, arguments)], stdout=stdout, stderr=stderr, text=True,
                              timeout=120, check=False, cwd=self.dir, user=self.user)

    def may_run(self):
        try:
            return self.run_bake('--version').returncode == 0
        except PermissionError:
            return False

    def succeed(self, *arguments):
        result = self.run_bake(*arguments)
        self.assertEqual(result.returncode, 0, f'{arguments}\n{result.stdout}{result.stderr}')
        return result

    def refuse(self, arguments, code, mentions):
        """The command fails with `code` (a name of exit_codes.h), tells `mentions` on stderr, claims
        nothing on stdout, and leaves the folder as it was."""
        before = snapshot(self.dir)
        result = self.run_bake(*arguments)
        said = f'{arguments}\nexit {result.returncode}\n{result.stdout}{result.stderr}'
        self.assertEqual(result.returncode, EXIT[code], said)
        self.assertEqual(result.stdout, '', said)
        # On a slow machine lines of progress come first.
        error = re.sub(r'\A(\s*\d+ %.*\n)+', '', result.stderr)
        self.assertTrue(error.startswith('sherd-bake: ') or code == 'Usage', said)
        self.assertTrue(result.stderr.endswith('\n'), said)
        for mention in mentions:
            self.assertIn(mention, result.stderr, said)
        self.assertEqual(snapshot(self.dir), before, said)
        return result

    def refuse_bake(self, model, maps, code, mentions, extra=()):
        """Both without an output file and with an older one, which must stay as it is."""
        arguments = ['bake', model, '-o', self.dir / 'out.glb', *extra]
        for path in maps:
            arguments += ['--map', path]
        self.refuse(arguments, code, mentions)
        older = self.write('out.glb', b'an older bake')
        self.refuse(arguments, code, mentions)
        older.unlink()
