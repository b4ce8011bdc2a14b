"""Cloth and soft bodies in Blender, simulated by the program `pliant` beside it.

    properties.py  what is set for an object and for a scene
    panels.py      where it is set
    operators.py   the buttons
    bake.py        from the button to the cache, in small pieces, so that the window goes on
    export.py      the scene of Blender as a scene file
    exported_object.py, weather.py, participants.py
                   its objects, its gravity and winds, and who takes part
    baked_files.py the files of a bake, and the modifier that plays them
    program.py     the program: where it is, what it says

docs/blender.md has the manual.
"""

bl_info = {
    "name": "Pliant",
    "author": "The Pliant developers",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Properties > Physics, and the sidebar of the 3D view",
    "description": "Cloth and soft bodies that nothing passes through",
    "category": "Physics",
}

from . import operators, panels, program, properties

MODULES = (program, properties, operators, panels)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
