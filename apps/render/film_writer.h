#pragma once
// Writes frames to a film, encoded by ffmpeg, or to numbered pictures.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "render/image.h"

namespace pliant_render {

enum class FilmFormat { png, mp4, webm, webp, gif };

/// The format for the extension of a name, in upper or lower case; none if it is unknown.
std::optional<FilmFormat> film_format_of(const std::filesystem::path& path);

struct FilmOptions {
  std::filesystem::path out;  ///< its extension chooses the format
  int width = 0;              ///< of every frame [pixels]
  int height = 0;             ///< of every frame [pixels]
  int fps = 30;               ///< frames per second, at least 1; a WebP or GIF shows at most 50
  int frame_count = 1;        ///< PNG: 1 writes one file of that name, more are numbered; only a hint for films
};

/// Takes frames one by one and keeps none in memory. A film gets its name only in close(); an MP4 of odd width or
/// height gets one more black column or row. Without ffmpeg in PATH, numbered pictures are written instead,
/// "film-0000.png" and so on. A writer destroyed without close(), or after an error, leaves complete pictures and no
/// part of a film.
class FilmWriter {
 public:
  /// Starts ffmpeg if the format needs it.
  /// @throws pliant::Error (input) for an invalid name or number, (output) if no film can be written there.
  explicit FilmWriter(FilmOptions options);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// @throws pliant::Error (output) if the frame cannot be written, with the last lines of ffmpeg's output;
  ///   std::logic_error for a frame of another size, or for a second one where frame_count promised one picture.
  void add(const Image& frame);

  /// Finishes the film; call it once, last.
  /// @returns what was written, for people: "film.mp4", or "film-0000.png to film-0099.png"
  /// @throws pliant::Error (output), as add(); std::logic_error without frames.
  std::string close();

  /// Empty, or a sentence saying that ffmpeg is missing and how to make the film from the pictures; known from the
  /// start.
  const std::string& hint() const { return hint_; }

 private:
  class Ffmpeg;

  std::filesystem::path numbered(int frame) const;

  FilmOptions options_;
  FilmFormat format_;
  std::unique_ptr<Ffmpeg> ffmpeg_;  ///< null for pictures
  std::string hint_;
  int added_ = 0;
  bool is_closed_ = false;
};

}  // namespace pliant_render
