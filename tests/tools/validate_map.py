#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""validate_map.py SCHEMA FILE...: fracture maps against their schema, and what it must refuse."""
import copy
import json
import pathlib
import re
import sys

import jsonschema

# Each makes a good map bad: the path to a member, and what it becomes.
DAMAGE = [
    (["sherdMap"], 2),
    (["lines"], {}),
    (["lines", 0, "points"], [[0, 0]]),
    (["lines", 0, "points"], [[0, 0], [1, 9]]),
    (["lines", 0, "points"], [[0, 0, 0], [1, 1, 1]]),
    (["lines", 0, "curve"], "spline"),
    (["lines", 0, "degree"], 11),
    (["lines", 0, "weights"], [1, 0]),
    (["lines", 0, "knots"], [0, "1", 2]),
    (["lines", 0, "level"], 0),
    (["lines", 0, "strength"], -1),
    (["lines", 0, "toughness"], "5"),
    (["lines", 0], {"surface": True, "curve": "bezier", "points": [[0, 0], [1, 1]]}),
    (["lines", 0], {"surface": True, "points": [[0, 0], [1, 1, 1, 1]]}),
    (["defaults"], {"level": 65}),
    (["labels"], [{"name": "no place"}]),
    (["labels"], [{"at": [0, 9]}]),
    (["labels"], [{"at": [0, 0], "density": 0}]),
    (["labels"], [{"at": [0, 0], "anchor": 1}]),
    (["labels"], [{"at": [0, 0], "level": -1}]),
]


# A string, kept whole, or a comment, dropped.
STRING_OR_COMMENT = re.compile(r'"(?:[^"\\]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def load(path):
    text = pathlib.Path(path).read_text()
    return json.loads(STRING_OR_COMMENT.sub(lambda m: m[0] if m[0][0] == '"' else "", text))


def damaged(document, path, value):
    document = copy.deepcopy(document)
    target = document
    for key in path[:-1]:
        target = target[key]
    target[path[-1]] = value
    return document


def main():
    schema = json.loads(pathlib.Path(sys.argv[1]).read_text())
    jsonschema.Draft4Validator.check_schema(schema)
    validator = jsonschema.Draft4Validator(schema)
    failures = 0
    for name in sys.argv[2:]:
        document = load(name)
        for error in validator.iter_errors(document):
            print(f"{name}: /{'/'.join(map(str, error.absolute_path))}: {error.message}")
            failures += 1
        for path, value in DAMAGE:
            if validator.is_valid(damaged(document, path, value)):
                print(f"{name}: the schema accepts {value} at {path}")
                failures += 1
        print(f"{name}: checked, and {len(DAMAGE)} damaged copies")
    return 1 if failures or len(sys.argv) < 3 else 0


sys.exit(main())
