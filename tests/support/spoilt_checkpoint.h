#pragma once
// What is said of a checkpoint in which something was changed by hand.
#include <functional>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "tests/support/checkpoint_bytes.h"

namespace pliant_tests {

using ContactChange = std::function<void(nlohmann::json&)>;

/// The message that refuses the content of a checkpoint with a change in state.contact; "(taken)" if it is not refused.
inline std::string refusal_of_contact(const nlohmann::json& content, const ContactChange& spoil) {
  nlohmann::json changed = content;
  spoil(changed["state"]["contact"]);
  std::string bytes;
  nlohmann::json::to_cbor(changed, bytes);
  try {
    pliant::parse_checkpoint(checkpoint_bytes(bytes, 4), "run.pliant", {});
  } catch (const pliant::Error& error) {
    return error.what();
  }
  return "(taken)";
}

/// The change is refused in one line that has this in it.
inline void check_refusal_of_contact(const nlohmann::json& content, const std::string& what,
                                     const ContactChange& spoil) {
  const std::string message = refusal_of_contact(content, spoil);
  CAPTURE(message);
  CHECK(message.starts_with("run.pliant: state"));
  CHECK(message.find(what) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace pliant_tests
