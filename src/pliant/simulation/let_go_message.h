#pragma once
#include <string>

#include "pliant/collision/contact/let_go_state.h"
#include "pliant/simulation/records.h"

namespace pliant {

/// What a user is told of bodies of which something is let go.
struct LetGoMessage {
  std::string begin;  ///< who and why: the same for each time that these do
  std::string end;    ///< where

  LetGoMessage(const LetGoBodies& let_go, const std::vector<Body>& bodies);
};

}  // namespace pliant
