# SPDX-License-Identifier: MIT
"""Is an OBJ a closed, consistently wound surface? Positions are one where their text is one, so
nothing is rounded or welded by a tolerance here."""
from collections import Counter


def read_obj(path):
    """Positions as text, triangles as triples of those texts."""
    positions, triangles = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            positions.append(tuple(words[1:4]))
        elif words[:1] == ['f']:
            corners = [positions[int(w.split('/')[0]) - 1] for w in words[1:]]
            triangles += [(corners[0], corners[k], corners[k + 1])
                          for k in range(1, len(corners) - 1)]
    return positions, triangles


def why_not_closed(path):
    """Empty when every edge is used as often in one direction as in the other; else the reason."""
    _, triangles = read_obj(path)
    if not triangles:
        return 'no faces'
    edges = Counter()
    for t in triangles:
        if len(set(t)) < 3:
            return f'a face with two equal corners: {t}'
        for k in range(3):
            edges[(t[k], t[(k + 1) % 3])] += 1
    for (a, b), count in edges.items():
        if edges[(b, a)] != count:
            return f'edge {a} to {b}: {count} times, {edges[(b, a)]} times back'
    return ''


def volume(path):
    total = 0.0
    for t in read_obj(path)[1]:
        a, b, c = (tuple(float(x) for x in p) for p in t)
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                  + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total
