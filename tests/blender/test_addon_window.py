"""The add-on in a Blender with a window: baking goes on beside it, and a real Escape ends it. Skipped where there is no
Blender, or no display for it."""
import os
import shutil
import subprocess
import sys

needed = [program for program in ("blender", "xvfb-run", "xdotool") if shutil.which(program) is None]
if needed:
    print("skipped: not installed: " + ", ".join(needed))
    sys.exit(77)

cases = os.path.join(os.path.dirname(os.path.abspath(__file__)), "window_cases.py")
environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
verdict = os.path.abspath("verdict.txt")
if os.path.exists(verdict):
    os.remove(verdict)
display = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24 -noreset"]
options = ["--factory-startup", "--no-window-focus", "--window-geometry", "0", "0", "1280", "800"]
command = [*display, "blender", *options, "--python", cases, "--", verdict]
try:
    subprocess.run(command, env=environment, check=False, timeout=400)
except subprocess.TimeoutExpired:
    print("FAILED: Blender did not come to its end")
    sys.exit(1)
if not os.path.exists(verdict):
    print("FAILED: Blender ended before its cases did; where it needs a newer OpenGL than there is, it says so above")
    sys.exit(1)
with open(verdict, encoding="utf-8") as file:
    text = file.read()
print(text)
sys.exit(0 if text.startswith("passed") else 1)
