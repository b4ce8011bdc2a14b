#pragma once
// The three standard streams.

namespace pliant_system {

/// To be called first. A closed standard stream becomes the null device, so that no file of a run takes its number and
/// with it what is printed there; a reader that has gone and a file past its limit become errors of the write.
void guard_streams();

enum class Stream { input, output, error };
/// Whether people are at its other end.
bool is_terminal(Stream stream);

}  // namespace pliant_system
