#include "viewer/film_thread.h"

#include <utility>

namespace pliant_viewer {
namespace {

constexpr std::size_t most_waiting = 4;  // pictures, of 2.8 MB each at 1280 x 720

}  // namespace

FilmThread::FilmThread(const pliant_render::FilmOptions& options) : writer_(options), thread_([this] { work(); }) {}

FilmThread::~FilmThread() {
  end();
  thread_.join();
}

void FilmThread::add(pliant_render::Image picture, int times) {
  std::unique_lock lock(mutex_);
  news_.wait(lock, [this] { return waiting_.size() < most_waiting || is_over_; });
  if (is_over_ || is_ended_) return;
  waiting_.push_back({std::move(picture), times});
  news_.notify_all();
}

void FilmThread::end() {
  const std::lock_guard lock(mutex_);
  is_ended_ = true;
  news_.notify_all();
}

bool FilmThread::is_over() const {
  const std::lock_guard lock(mutex_);
  return is_over_;
}

std::string FilmThread::wait() {
  std::unique_lock lock(mutex_);
  news_.wait(lock, [this] { return is_over_; });
  if (error_) std::rethrow_exception(error_);
  return written_;
}

void FilmThread::work() {
  std::exception_ptr error;
  try {
    write_all();
  } catch (const std::exception&) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  error_ = error;
  is_over_ = true;
  waiting_.clear();
  news_.notify_all();
}

void FilmThread::write_all() {
  bool has_pictures = false;
  while (true) {
    Entry entry;
    {
      std::unique_lock lock(mutex_);
      news_.wait(lock, [this] { return !waiting_.empty() || is_ended_; });
      if (waiting_.empty()) break;
      entry = std::move(waiting_.front());
      waiting_.pop_front();
      news_.notify_all();
    }
    for (int i = 0; i < entry.times; ++i) writer_.add(entry.picture);
    has_pictures = true;
  }
  if (!has_pictures) return;
  std::string written = writer_.close();
  const std::lock_guard lock(mutex_);
  written_ = std::move(written);
}

}  // namespace pliant_viewer
