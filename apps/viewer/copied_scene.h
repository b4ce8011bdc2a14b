#pragma once
// A scene that a program has made, to begin with and to start over from.
#include "viewer/session.h"

namespace pliant_viewer {

/// Takes the scene over, and makes it again: what was read from a file and not changed since by reading that again,
/// unless `is_program` says that more than the file is to it, everything else as a copy, without its text. What it
/// makes later throws Error(input) where the simulation cannot be copied.
MakeScene maker_of(pliant::Scene scene, bool is_program);

}  // namespace pliant_viewer
