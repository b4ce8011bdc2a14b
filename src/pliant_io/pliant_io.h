#pragma once
// Everything that a first program needs of files: meshes, scenes, checkpoints, recordings, exports.
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/checkpoint/state_file.h"
#include "pliant_io/export/export.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/mesh/obj.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/scene/scene.h"
