"""From the button to the cache, in small pieces, so that the window goes on."""

import os
import time

import bpy

from . import baked_files, export, program

SLICE = 0.05  # [s] after which the window has its turn
WITH_FRAMES = {0, 3, 130}  # exit codes: done, diverged, stopped


class BakeError(Exception):
    """What went wrong; one line."""


class Bake:
    """A bake at work. `advance` until `is_done`."""

    def __init__(self, context, resumes):
        self._scene_name = context.scene.name  # another one may be looked at by the time that it ends
        self.is_done = False
        self.text = ""
        self.share = 0.0
        self.is_baked = False  # whether there are frames to be seen
        self._run = None
        self._folder, self._is_kept = baked_files.folder_of(context.scene)
        self._parts = self._all_parts(context, resumes)

    @property
    def settings(self):
        """Those of the scene that is baked."""
        return self._scene().pliant

    @property
    def is_reading(self):
        """Whether the scene is being read, so that it must stay as it is."""
        return self._run is None

    def _scene(self):
        scene = bpy.data.scenes.get(self._scene_name)
        if scene is None:
            raise BakeError(f'The scene "{self._scene_name}" is gone')
        return scene

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
            self._parts.close()  # which puts back what the export has moved
            self.is_done = True

    def abandon(self):
        """Ends the program without waiting for anything."""
        self._parts.close()
        if self._run is not None:
            self._run.stop()

    def _all_parts(self, context, resumes):
        program.path()  # before anything is written
        if resumes:
            bake = self._what_to_resume(context.scene)
        else:
            for share in export.export(context, self._folder):
                self.text, self.share = f"Reading the animation: {share:.0%}", 0
                yield False
            bake = baked_files.read_bake(self._folder)
        yield from self._simulate(context.scene.frame_end - bake["first_frame"], bake, resumes)
        if baked_files.recorded_frames(self._folder) is None:
            return  # it was stopped before there was anything
        self.text = "Writing the cache"
        for _ in baked_files.write_caches(self._folder, bake):
            yield False
        self._play(self._scene(), bake)

    def _what_to_resume(self, scene):
        bake = baked_files.read_bake(self._folder)
        if bake is None or baked_files.recorded_frames(self._folder) is None:
            raise BakeError("There is nothing to go on from; choose Bake")
        if scene.frame_end > bake["last_frame"] and bake["is_animated"]:
            raise BakeError(
                f"Pins or colliders are animated, and were read up to frame {bake['last_frame']}; choose Bake to go on "
                "behind it"
            )
        if scene.frame_end > bake["last_frame"]:
            baked_files.extend(self._folder, bake, scene.frame_end)
        return bake

    def _simulate(self, frames, bake, resumes):
        """Runs the program for so many frames, and waits for its end."""
        folder = os.path.join(self._folder, baked_files.RUN)
        every = ["--checkpoint", str(10 * bake["steps"]), "--quiet"]
        total = str(frames * bake["steps"])
        if resumes:
            self._run = program.Run("resume", folder, "--steps", total, *every)
        else:
            scene = os.path.join(self._folder, baked_files.SCENE)
            baked_files.remove_run(self._folder)  # or a run that fails would pass for the one before
            self._run = program.Run("run", scene, "--out", folder, *every)
        while self._run.is_running():
            done = self._frames_done()
            self.text = f"Frame {bake['first_frame'] + done} of {bake['first_frame'] + frames}"
            self.share = done / frames
            yield True
        messages = self._run.messages()
        if self._run.exit_code() not in WITH_FRAMES:
            raise BakeError(messages[-1] if messages else "The program ended without a word")
        if not self._is_kept:
            messages.append("The file is not saved, so the bake goes when Blender ends; save it and bake again")
        self.settings.messages = "\n".join(messages)

    def _frames_done(self):
        recorded = baked_files.recorded_frames(self._folder)
        return 0 if recorded is None else max(0, len(recorded) - 1)

    def _play(self, scene, bake):
        for entry in bake["objects"]:
            obj = bpy.data.objects.get(entry["name"])
            if obj is not None:
                baked_files.play(obj, os.path.join(self._folder, entry["cache"]), bake["first_frame"])
        scene.pliant.baked_from = bake["first_frame"]
        scene.pliant.baked_to = bake["first_frame"] + self._frames_done()
        scene.pliant.planned_to = scene.frame_end
        self.is_baked = True

