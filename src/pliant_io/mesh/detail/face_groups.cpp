#include "pliant_io/mesh/detail/face_groups.h"

#include <algorithm>

#include <fmt/format.h>

namespace pliant {

namespace {

constexpr std::size_t max_groups_of_a_face = 256;

}  // namespace

FaceGroupsBuilder::FaceGroupsBuilder(Mesh& mesh, std::uint64_t file_size)
    : mesh_(mesh), max_groups_((1 << 16) + file_size / 64), memberships_left_((1 << 20) + file_size / 8) {}

void FaceGroupsBuilder::clear_groups() {
  group_names_.clear();
  is_current_ = false;
}

std::string FaceGroupsBuilder::add_group(std::string_view name) {
  if (group_names_.size() == max_groups_of_a_face) {
    return fmt::format("more than {} groups at once; give a face fewer groups", max_groups_of_a_face);
  }
  group_names_.emplace_back(name);
  is_current_ = false;
  return {};
}

void FaceGroupsBuilder::set_name(FaceGroupKind kind, std::string name) {
  (kind == FaceGroupKind::object ? object_ : material_) = std::move(name);
  is_current_ = false;
}

std::string FaceGroupsBuilder::add_face(Index face) {
  if (!is_current_) {
    if (std::string message = enter_current(); !message.empty()) return message;
  }
  if (current_.size() > memberships_left_) {
    return "too many faces in too many groups at once for a file of this size; put fewer names into the g lines";
  }
  memberships_left_ -= current_.size();
  for (const std::size_t group : current_) mesh_.groups[group].faces.push_back(face);
  return {};
}

std::string FaceGroupsBuilder::enter_current() {
  current_.clear();
  std::string message;
  if (!object_.empty()) message = enter(FaceGroupKind::object, object_);
  for (std::size_t i = 0; i < group_names_.size() && message.empty(); ++i) {
    message = enter(FaceGroupKind::group, group_names_[i]);
  }
  if (!material_.empty() && message.empty()) message = enter(FaceGroupKind::material, material_);
  is_current_ = true;
  return message;
}

std::string FaceGroupsBuilder::enter(FaceGroupKind kind, const std::string& name) {
  const auto [entry, is_new] = index_.try_emplace({kind, name}, mesh_.groups.size());
  if (is_new) {
    if (mesh_.groups.size() == max_groups_) {
      return fmt::format("more than {} groups, objects and materials for a file of this size; join some", max_groups_);
    }
    mesh_.groups.push_back({name, kind, {}});
  }
  if (std::ranges::find(current_, entry->second) == current_.end()) current_.push_back(entry->second);
  return {};
}

}  // namespace pliant
