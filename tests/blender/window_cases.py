"""Drives the add-on in the window of Blender, a step at a tick of a timer. Run by test_addon_window.py, with the name
of the file for the verdict behind --."""
import os
import shutil
import subprocess
import sys
import tempfile
import time
import traceback

import addon_utils
import bpy

sys.path.insert(0, os.path.join(os.environ["PLIANT_SOURCE_DIR"], "integrations", "blender"))
addon_utils.enable("pliant_blender", default_set=True)
from pliant_blender import baked_files, operators  # noqa: E402

VERDICT = sys.argv[sys.argv.index("--") + 1]
FOLDER = tempfile.mkdtemp(prefix="pliant_blender_")
TICK = 0.05  # [s]
PATIENCE = 120  # [s] for each thing that is waited for


def window():
    return bpy.context.window_manager.windows[0]


def call(operator):
    with bpy.context.temp_override(window=window(), area=window().screen.areas[0]):
        return operator("INVOKE_DEFAULT")


def press(key):
    subprocess.run(["xdotool", "mousemove", "400", "400", "key", key], check=True)


def until(condition):
    """Ticks until something holds."""
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited {PATIENCE} s in vain")
        yield


def story():
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.addons["pliant_blender"].preferences.program = os.environ["PLIANT"]
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "work.blend"))
    scene = bpy.context.scene
    settings = scene.pliant
    scene.frame_end = 1500  # more than can be simulated before Escape is pressed
    with bpy.context.temp_override(window=window()):
        bpy.data.objects["Cube"].pliant.role = "COLLIDER"
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=40, y_subdivisions=40, size=4, location=(0, 0, 1.2))
        sheet = bpy.context.object
    sheet.pliant.role = "CLOTH"

    print("a bake goes on beside the window")
    assert call(bpy.ops.pliant.bake) == {"RUNNING_MODAL"}
    assert not bpy.ops.pliant.bake.poll(), "two bakes at once"
    texts = set()

    def frame_told():
        bake = operators.at_work()
        assert bake is not None, settings.messages
        texts.add(bake.text)
        return bake.text.startswith("Frame ") and bake.share > 0.005

    yield from until(frame_told)
    assert len(texts) > 1, texts
    ticks = [time.monotonic()]
    while len(ticks) < 10:
        yield
        ticks.append(time.monotonic())
    assert ticks[-1] - ticks[0] < 20, "the window waits for the program"

    print("Escape ends it, and keeps what is there")
    press("Escape")
    yield from until(lambda: operators.at_work() is None)
    stopped_at = baked_files.baked_range(scene).last
    assert 1 < stopped_at < 1500, stopped_at
    assert scene.frame_current == 1, scene.frame_current
    scene.frame_set(stopped_at)
    sheet = bpy.data.objects["Grid"]
    assert sheet.modifiers["Pliant"].show_viewport

    print("it goes on to its end")
    scene.frame_end = stopped_at + 20
    assert call(bpy.ops.pliant.resume) == {"RUNNING_MODAL"}
    yield from until(lambda: operators.at_work() is None)
    assert baked_files.baked_range(scene).last == scene.frame_end, settings.messages

    print("the button Stop")
    assert call(bpy.ops.pliant.bake) == {"RUNNING_MODAL"}
    yield from until(lambda: operators.at_work() is None or operators.at_work()._run is not None)
    assert bpy.ops.pliant.stop() == {"FINISHED"}  # the program has hardly begun
    yield from until(lambda: operators.at_work() is None)

    print("an undone bake leaves a Blender that bakes on")
    assert bpy.ops.pliant.free() == {"FINISHED"}
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message="before the bake")
    scene.frame_end = 20
    assert call(bpy.ops.pliant.bake) == {"RUNNING_MODAL"}
    yield from until(lambda: operators.at_work() is None)
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo()
    yield
    assert call(bpy.ops.pliant.bake) == {"RUNNING_MODAL"}
    yield from until(lambda: operators.at_work() is None)
    assert baked_files.baked_range(bpy.context.scene).last == bpy.context.scene.frame_end

    print("a bake that cannot be made says why")
    bpy.data.objects["Grid"].pliant.pins = "nothing"
    call(bpy.ops.pliant.bake)
    yield from until(lambda: operators.at_work() is None)
    assert "no vertex group" in bpy.context.scene.pliant.messages, bpy.context.scene.pliant.messages


steps = story()


def tick():
    try:
        next(steps)
        return TICK
    except StopIteration:
        text = "passed"
    except BaseException:
        text = "FAILED\n" + traceback.format_exc()
    shutil.rmtree(FOLDER, ignore_errors=True)
    with open(VERDICT, "w", encoding="utf-8") as file:
        file.write(text)
    bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=1)
