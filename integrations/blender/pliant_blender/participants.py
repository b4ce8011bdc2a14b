"""Which objects of a scene take part, whatever is hidden by an eye."""

import contextlib

from .baked_files import find_modifier, prepare_modifier

SIMULATED = ("CLOTH", "SOLID")


def _enabled_collections(layer):
    """A layer collection and those below it, without what is excluded or disabled in viewports."""
    if layer.exclude or layer.collection.hide_viewport:
        return
    yield layer
    for child in layer.children:
        yield from _enabled_collections(child)


def enabled_objects(view_layer):
    """Those that are not disabled in viewports, by themselves or with their collections, in the order of the scene."""
    enabled = {obj for layer in _enabled_collections(view_layer.layer_collection) for obj in layer.collection.objects}
    return [obj for obj in view_layer.objects if obj in enabled and not obj.hide_viewport]


def takes_part(obj, view_layer):
    """Whether an object is simulated, or met by what is."""
    return obj.type == "MESH" and obj.pliant.role != "NONE" and obj in enabled_objects(view_layer)


@contextlib.contextmanager
def all_shown(view_layer, objects):
    """Shows objects and collections that are hidden by their eyes, since Blender does not evaluate them else."""
    hidden_layers = [each for each in _enabled_collections(view_layer.layer_collection) if each.hide_viewport]
    for layer in hidden_layers:
        layer.hide_viewport = False
    hidden = [obj for obj in objects if obj.hide_get(view_layer=view_layer)]
    for obj in hidden:
        obj.hide_set(False, view_layer=view_layer)
    try:
        yield
    finally:
        for obj in hidden:
            obj.hide_set(True, view_layer=view_layer)
        for layer in hidden_layers:
            layer.hide_viewport = True


@contextlib.contextmanager
def without_bakes(objects):
    """Shows what is simulated as it is before its bake acts, without what stands behind that."""
    switched_off = []
    try:
        for obj in objects:
            if obj.pliant.role not in SIMULATED:
                continue
            prepare_modifier(obj, True)
            names = obj.modifiers.keys()
            for name in names[names.index(find_modifier(obj).name) :]:
                switched_off.append((obj, name, obj.modifiers[name].show_viewport))
                obj.modifiers[name].show_viewport = False
        yield
    finally:
        for obj, name, was_shown in switched_off:
            if name in obj.modifiers:
                obj.modifiers[name].show_viewport = was_shown


def _levels_differ(modifier, scene):
    """Whether a modifier makes another mesh in renders than in the viewport."""
    if modifier.show_render != modifier.show_viewport:
        return True
    if not hasattr(modifier, "render_levels") or not modifier.show_viewport:
        return False
    shown, rendered = modifier.levels, modifier.render_levels
    if scene.render.use_simplify:
        shown = min(shown, scene.render.simplify_subdivision)
        rendered = min(rendered, scene.render.simplify_subdivision_render)
    return shown != rendered


def render_warnings(scene, objects):
    """Of modifiers above a bake that would make another mesh in renders, which then cannot show the bake."""
    lines = []
    for obj in objects:
        bake = find_modifier(obj)
        if obj.pliant.role not in SIMULATED or bake is None:  # of a bake that goes on it may have been removed
            continue
        names = obj.modifiers.keys()
        for name in names[: names.index(bake.name)]:
            if _levels_differ(obj.modifiers[name], scene):
                lines.append(
                    f'"{obj.name}": the modifier "{name}" above Pliant differs between viewport and render, so renders '
                    "will not show the bake; make both alike, or move it below Pliant"
                )
    return lines
