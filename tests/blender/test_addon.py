"""The add-on for Blender, in a Blender without a window: addon_cases.py runs in it. Skipped where there is none."""
import os
import shutil
import subprocess
import sys

blender = shutil.which("blender")
if blender is None:
    print("skipped: the program blender is not installed (Debian's package blender)")
    sys.exit(77)

cases = os.path.join(os.path.dirname(os.path.abspath(__file__)), "addon_cases.py")
# Its own Python would load modules of the caller's; of the exit code it tells the script's only where it is asked to.
environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
options = ["--background", "--factory-startup", "--python-exit-code", "1"]
command = [blender, *options, "--python", cases, "--", *sys.argv[1:]]
sys.exit(subprocess.run(command, env=environment, check=False).returncode)
