"""Scene files as one would lay them out, for the scripts that make some."""
import json


def wrapped(item):
    """The text of an entry of a list, broken between values."""
    lines = [""]
    for piece in json.dumps(item).split(", "):
        if lines[-1] and len(lines[-1]) + len(piece) > 140:
            lines.append("")
        lines[-1] += piece + ", "
    return "\n      ".join(line.rstrip() for line in lines)[:-1]


def text_of(value):
    """JSON with a paragraph for each body and move."""
    lines = ["{"]
    for key, entry in value.items():
        comma = "" if key == list(value)[-1] else ","
        if isinstance(entry, list):
            lines.append(f'  "{key}": [')
            lines += ["    " + wrapped(item) + ("," if i + 1 < len(entry) else "") for i, item in enumerate(entry)]
            lines.append("  ]" + comma)
        else:
            lines.append(f'  "{key}": {json.dumps(entry)}{comma}')
    return "\n".join(lines) + "\n}\n"
