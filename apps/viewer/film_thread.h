#pragma once
// A film that is written beside the window, which does not wait for the encoder.
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "render/film_writer.h"

namespace pliant_viewer {

class FilmThread {
 public:
  /// @throws pliant::Error as FilmWriter does.
  explicit FilmThread(const pliant_render::FilmOptions& options);
  /// Ends the film, and waits until it is complete.
  ~FilmThread();
  FilmThread(const FilmThread&) = delete;
  FilmThread& operator=(const FilmThread&) = delete;

  /// Adds a picture, so many times one after another. Waits where the encoder is several pictures behind; does nothing
  /// once the film is over.
  void add(pliant_render::Image picture, int times);
  /// No more pictures come.
  void end();
  /// Whether the film is complete, or has failed.
  bool is_over() const;
  /// Waits for that. Returns what was written, for people; empty where no picture came.
  /// @throws pliant::Error (output): it could not be written.
  std::string wait();
  /// Empty, or that ffmpeg is missing, see FilmWriter::hint().
  const std::string& hint() const { return writer_.hint(); }

 private:
  struct Entry {
    pliant_render::Image picture;
    int times = 1;
  };
  void work();
  void write_all();

  pliant_render::FilmWriter writer_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Entry> waiting_;
  bool is_ended_ = false, is_over_ = false;
  std::string written_;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace pliant_viewer
