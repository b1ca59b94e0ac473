#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""validate_extension.py SCHEMA_DIR FILE...: the SHERD_mesh_fracture JSON against its schema."""
import json
import pathlib
import struct
import sys

import jsonschema

NAME = "SHERD_mesh_fracture"


def load_document(path):
    data = path.read_bytes()
    if data[:4] == b"glTF":
        (length,) = struct.unpack_from("<I", data, 12)
        data = data[20 : 20 + length]
    return json.loads(data)


def validators(folder):
    # References are file names, so every schema is known to the resolver under its own.
    store = {p.name: json.loads(p.read_text()) for p in folder.glob("*.schema.json")}
    for schema in store.values():
        jsonschema.Draft4Validator.check_schema(schema)

    def make(name):
        resolver = jsonschema.RefResolver(name, store[name], store=store)
        return jsonschema.Draft4Validator(store[name], resolver=resolver)

    return make(f"glTF.{NAME}.schema.json"), make(f"node.{NAME}.schema.json")


def main():
    root_validator, node_validator = validators(pathlib.Path(sys.argv[1]))
    failures = 0
    for name in sys.argv[2:]:
        document = load_document(pathlib.Path(name))
        jobs = [(root_validator, document["extensions"][NAME], "/extensions")]
        for i, node in enumerate(document["nodes"]):
            if NAME in node.get("extensions", {}):
                jobs.append((node_validator, node["extensions"][NAME], f"/nodes/{i}"))
        if len(jobs) < 2:
            print(f"{name}: no node carries the extension")
            failures += 1
        for validator, value, where in jobs:
            for error in validator.iter_errors(value):
                print(f"{name}: {where}/{'/'.join(map(str, error.absolute_path))}: {error.message}")
                failures += 1
        print(f"{name}: {len(jobs)} objects checked")
    return 1 if failures or len(sys.argv) < 3 else 0


sys.exit(main())
