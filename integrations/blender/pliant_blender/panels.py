"""Where it is set: the physics tab of the properties, and the sidebar of the 3D view."""

import textwrap

import bpy

from . import baked_files, operators, participants, program


def _material_of(settings):
    """The numbers of the material that an object is made of; none where the program is not found."""
    kind, name = ("sheet", settings.sheet) if settings.role == "CLOTH" else ("solid", settings.solid)
    try:
        return next((each for each in program.materials(kind) if each["name"] == name), {})
    except program.ProgramError:
        return {}


def _own_value(layout, settings, switch, value, usual):
    """A number that takes the place of the usual one, with its switch before it; else the usual one, a text."""
    row = layout.row(heading=settings.bl_rna.properties[value].name, align=True)
    row.prop(settings, switch, text="")
    if getattr(settings, switch):
        row.prop(settings, value, text="")
    else:
        row.label(text=usual)


def _number(material, key, factor, unit):
    return f"{material[key] * factor:.3g} {unit}".rstrip() if key in material else ""


def draw_object(layout, context, obj):
    """All that is set for an object."""
    settings = obj.pliant
    layout.use_property_split = True
    layout.use_property_decorate = False
    layout.prop(settings, "role")
    if settings.role == "NONE":
        return
    if not participants.takes_part(obj, context.view_layer):
        layout.label(text="Ignored: disabled in viewports", icon="ERROR")
    if settings.role == "COLLIDER":
        _own_value(layout, settings, "use_friction", "friction", "of the cloth")
        return
    column = layout.column()
    material = _material_of(settings)
    if settings.role == "CLOTH":
        column.prop(settings, "sheet")
        _own_value(column, settings, "use_weight", "weight", _number(material, "area_density", 1, "kg/m²"))
        _own_value(column, settings, "use_bending", "bending", _number(material, "bending", 1e6, "µN·m"))
    else:
        column.prop(settings, "solid")
        column.prop(settings, "spacing")
        _own_value(column, settings, "use_weight", "density", _number(material, "density", 1, "kg/m³"))
        _own_value(column, settings, "use_young", "young", _number(material, "young_modulus", 1e-3, "kPa"))
    _own_value(column, settings, "use_friction", "friction", _number(material, "friction", 1, ""))
    column.prop(settings, "use_self")
    column = layout.column()
    column.prop_search(settings, "pins", obj, "vertex_groups")
    sub = column.column()
    sub.active = bool(settings.pins)
    sub.prop(settings, "pin_stiffness")
    _draw_modifiers(layout, context, obj)


def _draw_modifiers(layout, context, obj):
    """Says which modifiers are simulated and which follow, where there are any."""
    found = baked_files.find_modifier(obj)
    if found is None:
        return
    place = obj.modifiers.find(found.name)
    before = [each.name for each in obj.modifiers[:place] if each.show_viewport]
    after = [each.name for each in obj.modifiers[place + 1 :] if each.show_viewport]
    if before:
        _draw_text(layout.column(align=True), context, "Simulated with " + ", ".join(before), "MODIFIER")
    if after:
        _draw_text(layout.column(align=True), context, "Added to the bake: " + ", ".join(after), "MODIFIER")


def _draw_text(layout, context, text, icon):
    """In as many lines as it needs."""
    width = max(24, int((context.region.width / context.preferences.system.ui_scale - 60) / 6.2))
    for line in textwrap.wrap(text, width, break_long_words=True):
        layout.label(text=line, icon=icon)
        icon = "BLANK1"


def draw_bake(layout, context):
    """The settings of the simulation as a whole, and its buttons."""
    settings = context.scene.pliant
    layout.use_property_split = True
    layout.use_property_decorate = False
    bake = operators.at_work()
    if bake is not None:
        if hasattr(layout, "progress"):  # since Blender 4.0
            layout.progress(factor=bake.share, text=bake.text)
        else:
            layout.label(text=bake.text, icon="TIME")
        row = layout.row()
        row.enabled = not bake.is_reading
        row.operator("pliant.stop", icon="CANCEL")
    else:
        layout.operator("pliant.bake", icon="PHYSICS")
        row = layout.row(align=True)
        row.operator("pliant.resume", icon="PLAY")
        row.operator("pliant.free", icon="TRASH")
        baked = baked_files.baked_range(context.scene)
        if baked is not None:
            text = f"Frames {baked.first} to {baked.last} are baked"
            if baked.planned > baked.last:
                text += f", of {baked.planned}"
            layout.label(text=text, icon="CHECKMARK")
        _draw_messages(layout, context)
    column = layout.column()
    column.enabled = bake is None
    column.prop(settings, "steps")
    column.prop(settings, "iterations")
    column.prop(settings, "distance")
    column.prop(settings, "folder")


def _draw_messages(layout, context):
    lines = context.scene.pliant.messages.splitlines()
    try:
        program.path()
    except program.ProgramError as error:
        lines = [str(error)]
    if not lines:
        return
    box = layout.box().column(align=True)
    for line in lines:
        _draw_text(box, context, line, "ERROR")


class _ObjectPanel:
    bl_label = "Pliant"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        draw_object(self.layout, context, context.object)


class _BakePanel:
    bl_label = "Bake"

    @classmethod
    def poll(cls, context):
        return context.scene is not None

    def draw(self, context):
        draw_bake(self.layout, context)


class PLIANT_PT_physics(_ObjectPanel, bpy.types.Panel):
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"


class PLIANT_PT_physics_bake(_BakePanel, bpy.types.Panel):
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "physics"
    bl_parent_id = "PLIANT_PT_physics"


class PLIANT_PT_sidebar(_ObjectPanel, bpy.types.Panel):
    bl_label = "Object"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Pliant"


class PLIANT_PT_sidebar_bake(_BakePanel, bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Pliant"


CLASSES = (PLIANT_PT_physics, PLIANT_PT_physics_bake, PLIANT_PT_sidebar, PLIANT_PT_sidebar_bake)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
