#!/usr/bin/env python3
"""Where two native builds of the program differ in a script's run results: their other vector instructions sum in another
order. Prints JSON for native_spread.json: by place the relative difference of numbers (above 1e-10), null for texts.

    native_spread.py LESSON=RECORD.json,RECORD.json ...

The records are those of `dynlab run lesson.lua` by a release build on a processor with AVX-512 and by the build of
`scripts/test --sanitize`, which has SSE2."""
import json
import sys

SMALLEST = 1e-10
PARTS = ("values", "tables", "answers", "texts", "sliders", "outputs")


def number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def compare(a, b, place, scale, found):
    if number(a) and number(b):
        size = max(abs(a), abs(b), scale)
        if abs(a - b) > SMALLEST * size:
            found[place] = float(f"{abs(a - b) / size:.1e}")
    elif isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
        for key in a:
            compare(a[key], b[key], f"{place}.{key}", 0, found)
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        largest = max([scale] + [abs(one) for one in a if number(one)])
        for i, (one, other) in enumerate(zip(a, b)):
            compare(one, other, f"{place}[{i}]", largest, found)
    elif a != b:
        found[place] = None


def in_pieces(outputs):
    """As the test has them: printed texts and figures one by one."""
    return {cell: [{part: entry[part]} for entry in entries for part in ("printed", "figure") if part in entry]
            for cell, entries in outputs.items()}


spread = {}
for lesson, files in (word.split("=") for word in sys.argv[1:]):
    first, second = (json.load(open(file)) for file in files.split(","))
    spread[lesson] = {}
    for record in (first, second):
        record["outputs"] = in_pieces(record["outputs"])
    for part in PARTS:
        compare(first.get(part, {}), second.get(part, {}), part, 0, spread[lesson])
print(json.dumps(spread, indent=1, sort_keys=True))
