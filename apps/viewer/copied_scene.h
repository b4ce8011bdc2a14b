#pragma once
// A scene that a program has made, to begin with and to start over from.
#include "viewer/session.h"

namespace pliant_viewer {

/// How a scene is made again.
struct Remaker {
  MakeScene make;           ///< throws Error(input) where its simulation cannot be copied
  bool reads_text = false;  ///< it is what its text says; else it is made without one
};

/// Of a scene, which is left as it is. What was read from a file and not changed since is read again, unless
/// `is_program` says that more than the file is to it; everything else is copied.
Remaker remaker_of(const pliant::Scene& scene, bool is_program);

/// Takes the scene over and hands it out, and then what is made again.
MakeScene maker_of(pliant::Scene scene, Remaker again);
inline MakeScene maker_of(pliant::Scene scene, bool is_program) {
  Remaker again = remaker_of(scene, is_program);
  return maker_of(std::move(scene), std::move(again));
}

}  // namespace pliant_viewer
