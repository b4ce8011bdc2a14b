"""From the button to the cache, in small pieces, so that the window goes on."""

import os
import time
import uuid

import bpy

from . import baked_files, export, participants, program

SLICE = 0.05  # [s] after which the window has its turn
WITH_FRAMES = {0, 3, 130}  # exit codes: done, diverged, stopped
NOT_KEPT = "The file is not saved, so the bake goes when Blender ends; save it and bake again"


class BakeError(Exception):
    """What went wrong; one line."""


class Bake:
    """A bake at work. `advance` until `is_done`."""

    def __init__(self, context, resumes):
        self.is_done = False
        self.is_reading = True  # the scene, which must stay as it is meanwhile
        self.text = ""
        self.share = 0.0
        self.baked = None  # the range of frames, when there are some to be seen
        self._mark = _marked(context.scene)
        self._run = None
        self._folder = None
        self._parts = self._all_parts(context, resumes)

    def scene(self):
        """The scene that is baked, or None where it is gone."""
        return _find_marked(bpy.data.scenes, *self._mark)

    def advance(self):
        """Works for a moment. Raises BakeError where it cannot go on; then it is done as well."""
        until = time.monotonic() + SLICE
        try:
            while time.monotonic() < until:
                if next(self._parts):  # there is nothing to do but wait
                    return
        except StopIteration:
            self.is_done = True
        except (BakeError, export.ExportError, program.ProgramError) as error:
            self.is_done = True
            raise BakeError(str(error)) from None
        except OSError as error:
            self.is_done = True
            raise BakeError(f"{error.filename or self._folder}: {error.strerror}") from None
        except BaseException:
            self.is_done = True
            raise

    def stop(self):
        """Ends it soon; what has been simulated by then is kept."""
        if self._run is not None:
            self._run.stop()
        else:
            self._parts.close()  # which puts back what the reading has moved
            self.is_done = True

    def abandon(self):
        """Ends the program without waiting for anything."""
        self._parts.close()
        if self._run is not None:
            self._run.stop()

    def _all_parts(self, context, resumes):
        program.check()  # before anything is written
        scene = context.scene
        if resumes:
            self._folder = baked_files.bake_folder(scene)
            yield from self._read_more(context)
        else:
            self._folder = baked_files.new_folder(scene)
            yield from self._read(context)
        bake = baked_files.read_bake(self._folder)
        names = {entry["name"] for entry in bake["objects"]}
        objects = [obj for obj in bpy.data.objects if obj.name_full in names]
        marks = {obj.name_full: _marked(obj) for obj in objects}
        warnings = participants.render_warnings(scene, objects)
        self.is_reading = False
        yield from self._simulate(bake, resumes, warnings)
        if baked_files.recorded_frames(self._folder) is None:
            baked_files.remove_bake(self._folder)  # it was stopped before there was anything
            return
        self.text = "Writing the cache"
        for _ in baked_files.write_caches(self._folder, bake):
            yield False
        self._play(bake, marks)

    def _read(self, context):
        try:
            for share in export.export(context, self._folder):
                self.text = f"Reading the animation: {share:.0%}"
                yield False
        except BaseException:
            baked_files.remove_bake(self._folder)
            raise

    def _read_more(self, context):
        bake = self._folder and baked_files.read_bake(self._folder)
        if not bake:
            raise BakeError("Nothing to resume; use Bake")
        end = context.scene.frame_end
        if len(baked_files.recorded_frames(self._folder)) > end - bake["first_frame"]:
            raise BakeError(f"All frames up to {end} are baked")
        if end > bake["last_frame"]:
            for share in export.extend(context, self._folder, bake):
                self.text = f"Reading the animation: {share:.0%}"
                yield False
        bake["planned"] = end
        baked_files.write_json(os.path.join(self._folder, baked_files.BAKE), bake)

    def _simulate(self, bake, resumes, warnings):
        """Runs the program up to the last frame of a bake, and waits for its end."""
        folder = os.path.join(self._folder, baked_files.RUN)
        options = ["--checkpoint", str(10 * bake["steps"]), "--quiet"]
        frames = bake["planned"] - bake["first_frame"]
        if resumes:
            self._run = program.Run("resume", folder, "--steps", str(frames * bake["steps"]), *options)
        else:
            scene_file = os.path.join(self._folder, baked_files.SCENE)
            self._run = program.Run("run", scene_file, "--out", folder, *options)
        while self._run.is_running():
            recorded = baked_files.recorded_frames(self._folder)
            done = 0 if recorded is None else len(recorded) - 1
            self.text = f"Frame {bake['first_frame'] + done} of {bake['planned']}"
            self.share = done / frames
            yield True
        messages = [line.replace(os.path.join(self._folder, ""), "") for line in self._run.messages()]
        if self._run.exit_code() not in WITH_FRAMES:
            if baked_files.recorded_frames(self._folder) is None:
                baked_files.remove_bake(self._folder)
            raise BakeError(messages[-1] if messages else "The program exited without a message")
        scene = self.scene()
        if scene is not None:
            kept = [] if baked_files.is_kept(scene) else [NOT_KEPT]
            scene.pliant.messages = "\n".join(warnings + messages + kept)

    def _play(self, bake, marks):
        scene = self.scene()
        for entry in bake["objects"]:
            cache = os.path.join(self._folder, entry["cache"])
            obj = _find_marked(bpy.data.objects, *marks[entry["name"]]) if entry["name"] in marks else None
            if obj is not None:
                baked_files.play(obj, cache, bake["first_frame"])
            elif scene is not None:
                gone = f'"{entry["name"]}" is gone; its cache is {cache}'
                scene.pliant.messages = "\n".join(filter(None, [scene.pliant.messages, gone]))
        if scene is None:
            raise BakeError(f"The scene is gone; its bake is in {self._folder}")
        parent = os.path.dirname(self._folder)
        scene.pliant.baked_folder = bpy.path.relpath(parent) if bpy.data.is_saved else parent
        baked_files.remove_others(self._folder)
        self.baked = baked_files.baked_range(scene)


def _marked(datablock):
    """Its name, and a mark by which it is found when it has another name."""
    datablock.pliant.mark = uuid.uuid4().hex
    return datablock.name, datablock.pliant.mark


def _find_marked(collection, name, mark):
    """Copies have the mark too, and undo takes it away: the name decides then."""
    found = [each for each in collection if each.pliant.mark == mark]
    named = [each for each in found or collection if each.name == name]
    return next(iter(named or found), None)
