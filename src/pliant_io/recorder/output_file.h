#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace pliant {

/// A file that grows while a run goes on and is complete after every flush(). All members throw Error (output) with
/// the path and the system's reason.
class OutputFile {
 public:
  /// Makes the file, in place of one that has its name.
  explicit OutputFile(std::filesystem::path path);
  /// Opens the file that is there, to go on behind its first bytes; the others are cut off.
  OutputFile(std::filesystem::path path, std::uintmax_t kept_bytes);

  void write(std::string_view bytes);
  /// Replaces the first bytes of the file.
  void write_at_start(std::string_view bytes);
  /// Hands everything written to the system.
  void flush();

 private:
  void open(const char* mode);
  [[noreturn]] void fail(int error_number) const;

  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }  // everything that counts has been flushed
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace pliant
