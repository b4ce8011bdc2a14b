"""What is set for an object and for a scene."""

import zlib

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import baked_files, program

SIMULATED = ("CLOTH", "SOLID")


def _number_of(name):
    """The number by which a file keeps the choice of a material, whatever list it stands in."""
    return zlib.crc32(name.encode()) & 0x7FFFFFFF


_kept = {}  # Blender does not keep the texts of lists that are made while it runs


def _choices(kind, fallback):
    def items(_self, _context):
        try:
            found = program.materials(kind)
        except program.ProgramError:
            found = [{"name": fallback, "description": "The program pliant was not found"}]
        _kept[kind] = [
            (each["name"], each["name"].replace("_", " ").title(), each["description"], _number_of(each["name"]))
            for each in found
        ]
        return _kept[kind]

    return items


def _role_changed(self, _context):
    baked_files.prepare_modifier(self.id_data, self.role in SIMULATED)


class PliantObject(bpy.types.PropertyGroup):
    """What an object is in a simulation."""

    role: EnumProperty(
        name="Type",
        items=(
            ("NONE", "None", "Pliant does not see this object"),
            ("CLOTH", "Cloth", "A sheet of cloth, leather, paper or rubber"),
            ("SOLID", "Soft Body", "A closed surface, filled with a soft solid"),
            ("COLLIDER", "Collider", "Goes where it is animated to; cloth and soft bodies meet it"),
        ),
        update=_role_changed,
    )
    sheet: EnumProperty(
        name="Material",
        description="What the cloth is made of",
        items=_choices("sheet", "cotton"),
        default=_number_of("cotton"),
    )
    solid: EnumProperty(
        name="Material",
        description="What the soft body is made of",
        items=_choices("solid", "silicone"),
        default=_number_of("silicone"),
    )
    use_weight: BoolProperty(name="Own Weight", description="Take this weight in place of the material's")
    weight: FloatProperty(
        name="Weight",
        description="Mass of a square meter of cloth, in kg",
        default=0.2,
        min=1e-4,
        soft_max=5,
        precision=3,
    )
    density: FloatProperty(
        name="Density", description="Mass of a cubic meter, in kg", default=1000, min=0.1, soft_max=10000
    )
    use_bending: BoolProperty(name="Own Bending", description="Take this bending stiffness in place of the material's")
    bending: FloatProperty(
        name="Bending",
        description="Bending stiffness in µN·m: silk 2, cotton 12, denim 17, felt 8000. "
        "More makes wider folds",
        default=100,
        min=0,
        soft_max=10000,
        precision=1,
    )
    use_young: BoolProperty(name="Own Stiffness", description="Take this stiffness in place of the material's")
    young: FloatProperty(
        name="Stiffness",
        description="Young's modulus in kPa: silicone 50, foam 100",
        default=50,
        min=0.01,
        soft_max=10000,
    )
    spacing: FloatProperty(
        name="Spacing",
        description="Side of the cubes of the lattice that fills the body. Two or three should fit across what is to "
        "bend; half of it makes eight times as many",
        subtype="DISTANCE",
        default=0.1,
        min=1e-4,
        soft_max=1,
    )
    use_friction: BoolProperty(name="Own Friction", description="Take this friction in place of the material's")
    friction: FloatProperty(
        name="Friction", description="Coulomb's coefficient; 0 is ice", default=0.5, min=0, soft_max=2, precision=2
    )
    use_self: BoolProperty(name="Self-Collision", description="Whether it touches itself", default=True)
    pins: StringProperty(
        name="Pins",
        description="Vertex group that is held where the animation has it: weight 1 exactly, less by springs",
    )
    pin_stiffness: FloatProperty(
        name="Springs",
        description="Stiffness of the springs that hold vertices with a weight below 1, in N/m, times the weight",
        default=100,
        min=1e-3,
        soft_max=1e5,
    )


class PliantScene(bpy.types.PropertyGroup):
    """What holds for a simulation as a whole, and what has been baked."""

    steps: IntProperty(
        name="Steps",
        description="In each frame. More are more exact, livelier and slower",
        default=3,
        min=1,
        max=1000,
        soft_max=20,
    )
    iterations: IntProperty(
        name="Iterations",
        description="Of each step; more make stiff cloth less stretchy, at their cost",
        default=20,
        min=1,
        max=10000,
        soft_max=200,
    )
    distance: FloatProperty(
        name="Distance",
        description="How far from each other surfaces come to rest; 0: a quarter of the short edges of cloth and soft bodies",
        subtype="DISTANCE",
        default=0,
        min=0,
        soft_max=0.1,
        precision=4,
    )
    folder: StringProperty(
        name="Folder",
        description="Where the bake is kept; empty: beside the .blend file, in a folder with its name",
        subtype="DIR_PATH",
    )
    baked_from: IntProperty(options={"HIDDEN"})
    baked_to: IntProperty(default=-1, options={"HIDDEN"})  # the last frame; less than the first one: nothing is baked
    planned_to: IntProperty(default=-1, options={"HIDDEN"})
    messages: StringProperty(options={"HIDDEN"})  # of the last bake, line by line


CLASSES = (PliantObject, PliantScene)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.pliant = PointerProperty(type=PliantObject)
    bpy.types.Scene.pliant = PointerProperty(type=PliantScene)


def unregister():
    del bpy.types.Scene.pliant
    del bpy.types.Object.pliant
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
