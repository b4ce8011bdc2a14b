#include "viewer/panels/film_panel.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>

namespace pliant_viewer {
namespace {

using pliant_render::FilmFormat;

constexpr std::array<const char*, 5> format_names = {"film, MP4", "film, WebM", "film, WebP", "film, GIF",
                                                     "pictures, PNG"};
constexpr std::array<FilmFormat, 5> formats = {FilmFormat::mp4, FilmFormat::webm, FilmFormat::webp, FilmFormat::gif,
                                               FilmFormat::png};

struct NamedSize {
  const char* name;
  std::array<int, 2> size;
};
constexpr std::array<NamedSize, 5> sizes = {
    NamedSize{"as the window", {0, 0}}, NamedSize{"1280 × 720", {1280, 720}}, NamedSize{"1920 × 1080", {1920, 1080}},
    NamedSize{"1080 × 1080", {1080, 1080}}, NamedSize{"1080 × 1920", {1080, 1920}}};
constexpr std::array<FilmQuality, 3> qualities = {FilmQuality::window, FilmQuality::smooth, FilmQuality::fine};
constexpr std::array<const char*, 3> quality_names = {"as the window", "smooth outlines", "all light, 16 samples"};
constexpr std::array<int, 5> rates = {24, 25, 30, 50, 60};

template <class List, class IsIt, class Name>
std::optional<std::size_t> menu(const char* id, const List& list, const IsIt& is_it, const Name& name) {
  std::optional<std::size_t> chosen;
  const auto present = std::ranges::find_if(list, is_it);
  const std::string shown = present == list.end() ? "" : std::string(name(*present));
  if (!ImGui::BeginCombo(id, shown.c_str())) return chosen;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (ImGui::Selectable(std::string(name(list[i])).c_str(), is_it(list[i]))) chosen = i;
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace

std::optional<std::array<float, 4>> FilmPanel::place_of(const std::string& what) const {
  const auto found = places_.find(what);
  if (found == places_.end()) return {};
  return found->second;
}

void FilmPanel::note_place(const std::string& what) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[what] = {low.x, low.y, high.x, high.y};
}

bool FilmPanel::draw_button(const FilmRecorder* film, float width) {
  const bool is_recording = film != nullptr && film->is_recording();
  ImGui::BeginDisabled(film != nullptr && !is_recording);
  const bool is_pressed = ImGui::Button(is_recording ? "End film##button" : "Film##button", {width, 0});
  ImGui::EndDisabled();
  note_place("button");
  explain(
      "V: films what is seen, as chosen below under Film, without marks of pins and of what is selected;\n"
      "time goes by at the chosen speed, and waits where a picture takes long; what stands still is not filmed");
  return is_pressed;
}

void FilmPanel::draw(const FilmRecorder* film) {
  if (film != nullptr) {
    row_label("film", "");
    wrapped_text(film->is_recording()
                     ? fmt::format("{:.1f} s, {} pictures", film->clock().length(), film->clock().pictures())
                     : "being completed ...");
  }
  ImGui::BeginDisabled(film != nullptr);
  draw_choices();
  ImGui::EndDisabled();
}

void FilmPanel::draw_choices() {
  row_label("format", "a film, encoded by ffmpeg, or numbered pictures; they are written into the current folder");
  const auto is_format = [&](FilmFormat format) { return format == choices.format; };
  const auto format_name = [](FilmFormat format) {
    return format_names[static_cast<std::size_t>(std::ranges::find(formats, format) - formats.begin())];
  };
  if (const auto chosen = menu("##format", formats, is_format, format_name)) choices.format = formats[*chosen];
  note_place("format");
  row_label("size", "in pixels; the film is seen from where the window's picture is");
  const auto is_size = [&](const NamedSize& each) { return each.size == choices.size; };
  if (const auto chosen = menu("##size", sizes, is_size, [](const NamedSize& each) { return each.name; })) {
    choices.size = sizes[*chosen].size;
  }
  note_place("size");
  row_label("rate", "pictures a second of the film");
  const auto is_rate = [&](int rate) { return rate == choices.fps; };
  const auto rate_name = [](int rate) { return fmt::format("{} a second", rate); };
  if (const auto chosen = menu("##rate", rates, is_rate, rate_name)) choices.fps = rates[*chosen];
  note_place("rate");
  row_label("quality",
            "of the film; time in the window waits for each picture, so finer ones slow it down there,\n"
            "and the film goes on evenly all the same");
  const auto is_quality = [&](FilmQuality quality) { return quality == choices.quality; };
  const auto quality_name = [](FilmQuality quality) { return quality_names[static_cast<std::size_t>(quality)]; };
  if (const auto chosen = menu("##quality", qualities, is_quality, quality_name)) choices.quality = qualities[*chosen];
  note_place("quality");
}

void draw_film_mark(const FilmRecorder& film, const pliant_render::AnnotationCanvas& canvas, float unit) {
  constexpr ImU32 red = IM_COL32(214, 40, 40, 255);
  const float size = 15 * unit, radius = 6 * unit, left = 22 * unit, top = 20 * unit;
  canvas.list.AddCircleFilled({left, top}, radius, red);
  const std::string text = film.is_recording() ? fmt::format("{:.1f} s", film.clock().length()) : "completing the film";
  canvas.list.AddText(&canvas.font, size, {left + 2 * radius, top - size / 2}, canvas.ink, text.c_str());
}

}  // namespace pliant_viewer
