# Reads DXF files with ezdxf and prints what it found, one JSON object a file: for tests.
# Exit status 77: there is no ezdxf.
import json
import math
import sys

try:
    import ezdxf
except ImportError:
    sys.exit(77)


def length(points, closed):
    pairs = list(zip(points, points[1:] + points[:1] if closed else points[1:]))
    return sum(math.dist(a, b) for a, b in pairs)


for name in sys.argv[1:]:
    document = ezdxf.readfile(name)
    audit = document.audit()
    lines, texts = [], []
    for entity in document.modelspace():
        row = {"layer": entity.dxf.layer, "color": entity.dxf.color, "type": entity.dxftype()}
        if row["type"] == "TEXT":
            texts.append(row | {"text": entity.dxf.text, "height": entity.dxf.height,
                                "rotation": entity.dxf.rotation, "at": list(entity.dxf.align_point)[:2]})
            continue
        if row["type"] == "LINE":
            points, closed = [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]], False
        else:
            points, closed = [tuple(p) for p in entity.get_points("xy")], bool(entity.closed)
        lines.append(row | {"closed": closed, "length": length(points, closed), "points": points})
    print(json.dumps({
        "version": document.dxfversion,
        "units": document.header["$INSUNITS"],
        "extent": list(document.header["$EXTMAX"])[:2],
        "layers": {layer.dxf.name: layer.dxf.color for layer in document.layers},
        "errors": [error.message for error in audit.errors],
        "fixes": [fix.message for fix in audit.fixes],
        "lines": lines,
        "texts": texts,
    }))
