# What of the tests is not run on other platforms than Linux on x86-64, each with its reason.
set(PLIANT_LEFT_OUT "")        # sources that are not built there
set(PLIANT_CASES_LEFT_OUT "")  # test cases that are not run

# In node, wine and above all qemu, which is 10 to 20 times slower, they take minutes; scene_bits runs these scenes.
if(CMAKE_CROSSCOMPILING)
  list(APPEND PLIANT_LEFT_OUT
    scene/test_builtin_scenes
    scene/test_contact_scenes
    scene/test_gallery_scenes
    scene/test_sewn_scenes)
endif()
# What takes more than three seconds natively takes minutes in qemu, which is about 30 times slower. On an ARM
# machine all of it runs.
if(CMAKE_CROSSCOMPILING_EMULATOR MATCHES "qemu")
  list(APPEND PLIANT_LEFT_OUT
    scene/test_let_go_scenes
    scene/test_surface_scenes
    solver/test_pair_bounce)
  list(APPEND PLIANT_CASES_LEFT_OUT
    "everything at once stays calm*"
    "few iterations: a stiff beam swings as it should*"
    "friction: the same in four substeps"
    "friction: what sticks does not creep*"
    "it weighs what the surface encloses*"
    "all tetrahedra are alike*"
    "let go: all that crosses in any frame was let go"
    "let go: all that crosses was let go*"
    "let go: piles that cross by chance"
    "let go: the same bits *"
    "animated bodies: a wave that runs through the floor lifts a sheet"
    "pair bits: the same for any number of threads"
    "pair bits: the same after a state is restored in the middle"
    "pairs: no crossing in ten piles drawn by chance"
    "pairs: no crossing when thrown at 30 m/s"
    "pairs: no crossing with half the contact distance*"
    "pairs: no crossing with steps of *"
    "an inverted* a flattened* a collapsed and a shuffled solid come back to rest"
    "in every built-in scene without colliders a step in single precision*"
    "two free bodies keep their momentum while they are sewn together")
endif()
if(NOT PLIANT_CHOLMOD)
  list(APPEND PLIANT_CASES_LEFT_OUT
    "the order of elimination: nested dissection*")
endif()
if(NOT PLIANT_VTU)
  list(APPEND PLIANT_CASES_LEFT_OUT
    "a format is found by its extension*"
    "numbers keep their bits in every format that has doubles"
    "the extension tells the format*")
endif()

if(EMSCRIPTEN)
  list(APPEND PLIANT_LEFT_OUT
    core/test_atomic_file         # locks of files, which node's are without
    core/test_thread_pool         # starts threads
    core/test_waited_count        # starts threads
    determinism/test_threads      # the same
    files/test_atomic_folder      # locks of folders
    files/test_posix_files        # links, pipes and limits
    materials/test_hung_material  # Bessel functions, which libc++ does not have
    solver/test_global_step)      # starts threads in all cases but one
  list(APPEND PLIANT_CASES_LEFT_OUT
    # they start threads
    "accelerations: with every constraint and force*the same bits for any number of threads"
    "the bits are the same on any number of threads*with BDF2*"
    "colliders: the bits are the same for any number of threads"
    "a mesh in random order moves as one in order*"
    "energies of components*"
    "few slots have one thread*"
    "in the wind as well the same bits for any number of threads*"
    "pair search: as many pairs as are allowed"
    "pair search: bodies that take no notice of themselves*"
    "pair search: the same for any number of threads"
    "pair search: too many pairs end in a message*"
    "passing groups: the same bits for any number of threads*"
    "rigid balance: the same bits for any number of threads"
    "the same bits for every number of threads*")
endif()

if(WIN32)
  list(APPEND PLIANT_LEFT_OUT
    files/test_posix_files)  # links, pipes and limits, which its file system does not have, or not for everyone
  list(APPEND PLIANT_CASES_LEFT_OUT
    # goes by a relative path to a folder for temporary files, which wine has on another drive
    "a name means the file beside the scene that says it*")
endif()

list(JOIN PLIANT_LEFT_OUT "|" PLIANT_LEFT_OUT)
list(JOIN PLIANT_CASES_LEFT_OUT "," PLIANT_CASES_LEFT_OUT)
