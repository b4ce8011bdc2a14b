#include "pliant_io/mesh/detail/vtk_numbers.h"

namespace pliant {

namespace {

struct VtkTypeName {
  std::string_view name;
  VtkType type;
};

constexpr std::array<VtkTypeName, 10> xml_type_names{{{"Int8", VtkType::int8},
                                                      {"UInt8", VtkType::uint8},
                                                      {"Int16", VtkType::int16},
                                                      {"UInt16", VtkType::uint16},
                                                      {"Int32", VtkType::int32},
                                                      {"UInt32", VtkType::uint32},
                                                      {"Int64", VtkType::int64},
                                                      {"UInt64", VtkType::uint64},
                                                      {"Float32", VtkType::float32},
                                                      {"Float64", VtkType::float64}}};

/// `long` and `vtkIdType` are of 8 bytes where most files come from; VTK itself takes the machine's.
constexpr std::array<VtkTypeName, 16> legacy_type_names{{{"char", VtkType::int8},
                                                         {"signed_char", VtkType::int8},
                                                         {"unsigned_char", VtkType::uint8},
                                                         {"short", VtkType::int16},
                                                         {"unsigned_short", VtkType::uint16},
                                                         {"int", VtkType::int32},
                                                         {"unsigned_int", VtkType::uint32},
                                                         {"long", VtkType::int64},
                                                         {"unsigned_long", VtkType::uint64},
                                                         {"vtkidtype", VtkType::int32},
                                                         {"vtktypeint32", VtkType::int32},
                                                         {"vtktypeuint32", VtkType::uint32},
                                                         {"vtktypeint64", VtkType::int64},
                                                         {"vtktypeuint64", VtkType::uint64},
                                                         {"float", VtkType::float32},
                                                         {"double", VtkType::float64}}};

template <std::size_t count>
std::optional<VtkType> find_vtk_type(const std::array<VtkTypeName, count>& names, std::string_view name) {
  const auto* found = std::ranges::find(names, name, &VtkTypeName::name);
  if (found == names.end()) return {};
  return found->type;
}

}  // namespace

std::optional<VtkType> xml_type(std::string_view name) {
  return find_vtk_type(xml_type_names, name);
}

std::optional<VtkType> legacy_type(std::string_view name) {
  return find_vtk_type(legacy_type_names, name);
}

std::size_t byte_count(VtkType type) {
  constexpr std::array<std::size_t, 10> counts = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return counts[static_cast<std::size_t>(type)];
}

}  // namespace pliant
