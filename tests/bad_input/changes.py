"""JSON values with one thing in them changed."""
import copy


def paths_of(value, path=()):
    """Every place in a JSON value but the root."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in entries:
        yield (*path, key)
        yield from paths_of(entry, (*path, key))


def value_at(value, path):
    for key in path:
        value = value[key]
    return value


def text_of(path):
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).lstrip(".")


def changed(scene, path, change):
    """A copy in which `change` was called with the container and the key that the path leads to."""
    result = copy.deepcopy(scene)
    container = result
    for key in path[:-1]:
        container = container[key]
    change(container, path[-1])
    return result


def replaced(scene, path, value):
    def change(container, key):
        container[key] = value
    return changed(scene, path, change)


def without(scene, path):
    def change(container, key):
        del container[key]
    return changed(scene, path, change)


def renamed(scene, path, name):
    def change(container, key):
        entries = [(name if k == key else k, value) for k, value in container.items()]
        container.clear()
        container.update(entries)
    return changed(scene, path, change)
