"""The buttons."""

import time

import bpy

from . import bake as baking
from . import baked_files

_at_work = None  # the bake that is going on, or None


def at_work():
    """The bake that is going on, or None."""
    return _at_work


class _Baking:
    """What Bake and Resume have in common: in the window with progress and Escape, in a script until it is done."""

    resumes = False

    @classmethod
    def poll(cls, context):
        if context.mode.startswith("EDIT"):
            cls.poll_message_set("Leave Edit Mode first")
            return False
        return _at_work is None and not bpy.app.is_job_running("RENDER")

    def execute(self, context):
        bake = baking.Bake(context, self.resumes)
        try:
            while not bake.is_done:
                bake.advance()
                time.sleep(0.001)
        except baking.BakeError as error:
            return self._failed(bake, error)
        except KeyboardInterrupt:
            bake.abandon()
            raise
        return self._succeeded(bake)

    def invoke(self, context, _event):
        global _at_work
        if bpy.app.background:
            return self.execute(context)
        _at_work = self._bake = baking.Bake(context, self.resumes)
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.window_manager.progress_begin(0, 100)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        is_escape = event.type == "ESC" and event.value == "PRESS" and not _is_playing(context)
        if is_escape:
            self._bake.stop()
        elif event.type != "TIMER":
            return {"RUNNING_MODAL"} if self._bake.is_reading else {"PASS_THROUGH"}
        try:
            if not self._bake.is_done:
                self._bake.advance()
        except baking.BakeError as error:
            return self._failed(self._bake, error)
        finally:
            if self._bake.is_done:
                self._end(context)
        if self._bake.is_done:
            return self._succeeded(self._bake)
        context.window_manager.progress_update(int(100 * self._bake.share))
        hint = "Esc: cancel" if self._bake.is_reading else "Esc: stop, and keep what is there"
        context.workspace.status_text_set(f"Pliant: {self._bake.text}     {hint}")
        _redraw(context)
        return {"RUNNING_MODAL"} if is_escape else {"PASS_THROUGH"}  # a timer is for others too

    def cancel(self, context):
        self._bake.abandon()
        self._end(context)

    def _end(self, context):
        global _at_work
        _at_work = None
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        _redraw(context)

    def _failed(self, bake, error):
        scene = bake.scene()
        if scene is not None:
            scene.pliant.messages = str(error)
        self.report({"ERROR"}, str(error))
        return {"CANCELLED"}

    def _succeeded(self, bake):
        if bake.baked is None:
            self.report({"INFO"}, "Pliant: stopped before a frame was simulated")
            return {"CANCELLED"}
        for line in bake.scene().pliant.messages.splitlines():
            self.report({"WARNING"}, line)
        self.report({"INFO"}, f"Pliant: baked frames {bake.baked.first} to {bake.baked.last}")
        return {"FINISHED"}


def _is_playing(context):
    """Escape ends the playing of an animation then."""
    return any(window.screen.is_animation_playing for window in context.window_manager.windows)


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"PROPERTIES", "VIEW_3D"}:
                area.tag_redraw()


class PliantBake(_Baking, bpy.types.Operator):
    """Simulate all cloth and soft bodies of the scene, from its start frame to its end frame"""

    bl_idname = "pliant.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}


class PliantResume(_Baking, bpy.types.Operator):
    """Continue a bake that was stopped, or simulate up to a later end frame, with the settings that it began with"""

    bl_idname = "pliant.resume"
    bl_label = "Resume"
    bl_options = {"REGISTER", "UNDO"}
    resumes = True

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        baked = baked_files.baked_range(context.scene)
        return baked is not None and baked.last < context.scene.frame_end


class PliantStop(bpy.types.Operator):
    """End the bake, and keep the frames that it has"""

    bl_idname = "pliant.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, _context):
        return _at_work is not None

    def execute(self, _context):
        _at_work.stop()
        return {"FINISHED"}


class PliantFree(bpy.types.Operator):
    """Remove the bake and its files"""

    bl_idname = "pliant.free"
    bl_label = "Free"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        folder = baked_files.scene_folder(context.scene)
        return _at_work is None and baked_files.is_own(context.scene, folder)

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def execute(self, context):
        baked_files.remove_all(context.scene)
        settings = context.scene.pliant
        settings.baked_folder = settings.messages = ""
        return {"FINISHED"}


CLASSES = (PliantBake, PliantResume, PliantStop, PliantFree)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    global _at_work
    if _at_work is not None:
        _at_work.abandon()
        _at_work = None
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
