"""What is set for an object and for a scene."""

import zlib

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import baked_files, program
from .participants import SIMULATED


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
    if self.id_data.type == "MESH":
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
    use_weight: BoolProperty(name="Override Weight", description="Use this instead of the material's weight")
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
    use_bending: BoolProperty(name="Override Bending", description="Use this instead of the material's bending stiffness")
    bending: FloatProperty(
        name="Bending",
        description="Bending stiffness in µN·m: silk 2, cotton 12, denim 17, felt 8000. "
        "More makes wider folds",
        default=100,
        min=0,
        soft_max=10000,
        precision=1,
    )
    use_young: BoolProperty(name="Override Stiffness", description="Use this instead of the material's stiffness")
    young: FloatProperty(
        name="Stiffness",
        description="Young's modulus in kPa: silicone 50, foam 100",
        default=50,
        min=0.01,
        soft_max=10000,
    )
    spacing: FloatProperty(
        name="Lattice Size",
        description="Side of the cubes of the lattice that fills the body. Two or three should fit across what is to "
        "bend; half of it makes eight times as many",
        subtype="DISTANCE",
        default=0.1,
        min=1e-4,
        soft_max=1,
    )
    use_friction: BoolProperty(name="Override Friction", description="Use this instead of the material's friction")
    friction: FloatProperty(
        name="Friction", description="Coulomb's coefficient; 0 is ice", default=0.5, min=0, soft_max=2, precision=2
    )
    use_self: BoolProperty(name="Self-Collision", description="Whether it touches itself", default=True)
    pins: StringProperty(
        name="Pins",
        description="Vertex group that is held where the animation has it: weight 1 exactly, less by springs",
    )
    pin_stiffness: FloatProperty(
        name="Stiffness",
        description="Of the springs that hold vertices with a weight below 1, in N/m, times the weight",
        default=100,
        min=1e-3,
        soft_max=1e5,
    )
    modifier: StringProperty(options={"HIDDEN"})  # the name of the one that plays the bake
    mark: StringProperty(options={"HIDDEN"})  # by which a bake finds its objects


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
        description="Of each step; more make stiff cloth less stretchy, at their cost. 0: as many as it needs",
        default=20,
        min=0,
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
    baked_folder: StringProperty(options={"HIDDEN"})  # where the last bake went; see baked_files.scene_folder
    mark: StringProperty(options={"HIDDEN"})  # by which a bake finds its scene
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
