#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Results to a page and pictures.
  report.py merge OUT.json [KEY=VALUE …] -- IN.json …    many runs become one result, with more said of the context
  report.py page RESULT.json                             RESULT.md, RESULT-roofline.svg, RESULT-scaling.svg beside it"""
import pathlib
import sys

import results
import table


def write_page(path):
    path = pathlib.Path(path)
    result = results.load(path)
    pictures = []
    try:
        import plots
    except ImportError as missing:
        print(f"{path.stem}: no pictures ({missing}; Debian: python3-matplotlib)", file=sys.stderr)
    else:
        pictures = plots.draw_all(result, path.with_suffix(""))
    path.with_suffix(".md").write_text(table.page(result, path.stem, [(c, f.name) for c, f in pictures]))


def main(argv):
    if argv[:1] == ["merge"] and "--" in argv:
        split = argv.index("--")
        out, context, inputs = argv[1], argv[2:split], argv[split + 1:]
        results.save(results.merge(inputs, [tuple(c.split("=", 1)) for c in context]), out)
    elif argv[:1] == ["page"] and len(argv) == 2:
        write_page(argv[1])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
