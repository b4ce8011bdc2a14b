// Values and selections from numbers and groups that come with a mesh.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"
#include "tests/support/temporary_folder.h"

namespace test_maps {

namespace {

using namespace pliant;
using pliant_tests::TemporaryFolder;

/// A strip of two squares, 0 1 2 over 3 4 5: the first in group "left" of object "cloth", the second of material "red".
constexpr std::string_view strip_obj =
    "o cloth\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
    "g left\nf 1 2 5 4\ng right\nusemtl red\nf 2 3 6 5\n";

constexpr std::string_view strip_ply = R"(ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
property float weight
element face 2
property list uchar int vertex_indices
end_header
0 0 0 0
1 0 0 0.5
2 0 0 1
0 1 0 0
1 1 0 0.5
2 1 0 1
4 0 1 4 3
4 1 2 5 4
)";

struct Files {
  TemporaryFolder folder;
  Files() {
    folder.write("strip.obj", strip_obj);
    folder.write("strip.ply", strip_ply);
    folder.write("map.txt", "0\n0.25\n0.5\n0.75\n1\n1\n");
    folder.write("positive.txt", "0.5\n0.25\n0.5\n0.75\n1\n1\n");
    folder.write("short.txt", "1\n2\n");
    folder.write("negative.txt", "1\n1\n1\n-1\n1\n1\n");
  }
  Scene load(const std::string& mesh, const std::string& more, const std::string& mass = R"({"per_vertex": 1})") const {
    return parse_scene(
        R"({"pliant": 1, "bodies": [{"mesh": {"file": ")" + mesh + R"("}, "mass": )" + mass + more + "}]}",
        folder.path(), "s.json");
  }
  std::vector<Index> selected(const std::string& mesh, const std::string& on) const {
    const Scene scene = load(mesh, R"(, "constraints": [{"type": "position", "on": )" + on + "}]");
    const auto& batch = *scene.simulation.groups().begin()->second.set.batches[0];
    return {batch.pinned_vertices().begin(), batch.pinned_vertices().end()};
  }
  std::string message_of(const std::string& mesh, const std::string& more,
                         const std::string& mass = R"({"per_vertex": 1})") const {
    try {
      load(mesh, more, mass);
    } catch (const Error& error) {
      return error.what();
    }
    return "(no error)";
  }
  std::string selection_error(const std::string& mesh, const std::string& on) const {
    return message_of(mesh, R"(, "constraints": [{"type": "position", "on": )" + on + "}]");
  }
};

using Vertices = std::vector<Index>;

TEST_CASE("selections by group, object, material and map") {
  const Files files;
  CHECK(files.selected("strip.obj", R"({"group": "left"})") == Vertices{0, 1, 3, 4});
  CHECK(files.selected("strip.obj", R"({"group": "cloth"})") == Vertices{0, 1, 2, 3, 4, 5});
  CHECK(files.selected("strip.obj", R"({"group": "red"})") == Vertices{1, 2, 4, 5});
  CHECK(files.selected("strip.ply", R"({"map": {"name": "weight"}, "above": 0.5})") == Vertices{2, 5});
  CHECK(files.selected("strip.ply", R"({"map": {"name": "weight"}, "above": 0.4, "below": 1})") == Vertices{1, 4});
  CHECK(files.selected("strip.obj", R"({"map": {"file": "map.txt"}, "below": 0.5})") == Vertices{0, 1});
}

TEST_CASE("selections of selections") {
  const Files files;
  const std::string left = R"({"group": "left"})";
  const std::string right = R"({"group": "right"})";
  CHECK(files.selected("strip.obj", R"({"any_of": [[5, 5], [0, 5]]})") == Vertices{0, 5});
  CHECK(files.selected("strip.obj", R"({"all_of": [)" + left + ", " + right + "]}") == Vertices{1, 4});
  CHECK(files.selected("strip.obj", R"({"all_of": [[5, 5], [0, 5]]})") == Vertices{5});
  CHECK(files.selected("strip.obj", R"({"not": )" + left + "}") == Vertices{2, 5});
  CHECK(files.selected("strip.obj", R"({"not": {"any_of": [[0], {"not": "all"}]}})") == Vertices{1, 2, 3, 4, 5});
  CHECK(files.selection_error("strip.obj", R"({"not": "all"})").find("no vertex is selected") != std::string::npos);
  CHECK(files.selection_error("strip.obj", R"({"any_of": []})").find("the list is empty") != std::string::npos);
  CHECK(files.selection_error("strip.obj", R"({"not": [9]})").find(".on.not[0]: vertex 9 is out") != std::string::npos);
}

TEST_CASE("selections that the mesh does not have") {
  const Files files;
  CHECK(files.selection_error("strip.obj", R"({"group": "lift"})")
            .find("no group, object, material or part 'lift'; did you mean 'left'?") != std::string::npos);
  CHECK(files.selection_error("strip.ply", R"({"group": "left"})").find("the mesh has no groups") != std::string::npos);
  CHECK(files.selection_error("strip.ply", R"({"map": {"name": "wight"}, "above": 0})")
            .find("unknown map 'wight'; did you mean 'weight'?") != std::string::npos);
  CHECK(files.selection_error("strip.obj", R"({"map": {"name": "x"}, "above": 0})").find("has no maps") !=
        std::string::npos);
  CHECK(files.selection_error("strip.ply", R"({"map": {"name": "weight"}})").find("neither 'above' nor 'below'") !=
        std::string::npos);
  CHECK(files.selection_error("strip.obj", R"({"map": {"file": "short.txt"}, "above": 0})")
            .find("2 numbers for 6 vertices") != std::string::npos);
  CHECK(files.selection_error("strip.obj", R"({"map": {"file": "none.txt"}, "above": 0})").find("no such file") !=
        std::string::npos);
}

TEST_CASE("a constraint has the mean of its vertices' values") {
  const Files files;
  const auto measures = [&](const std::string& constraint) {
    const Scene scene = files.load("strip.ply", R"(, "constraints": [)" + constraint + "]");
    const auto& batch = *scene.simulation.groups().begin()->second.set.batches[0];
    CHECK(batch.stiffness() == 1);
    return std::vector<Real>(batch.rest_measure().begin(), batch.rest_measure().end());
  };
  const std::string map = R"({"map": {"name": "weight"}, "from": 10, "to": 30})";
  CHECK(measures(R"({"type": "edge_spring", "stencils": [[0, 3], [0, 1], [1, 2], [2, 5], [0, 2]], "stiffness": )" +
                 map + "}") == std::vector<Real>{10, 15, 25, 30, 20});
  CHECK(
      measures(
          R"({"type": "edge_spring", "stencils": [[0, 1], [4, 5]], "stiffness": {"map": {"file": "positive.txt"}}})") ==
      std::vector<Real>{0.375, 1});
  CHECK(measures(R"({"type": "position", "hold": "soft", "stencils": [1, 2], "stiffness": )" + map + "}") ==
        std::vector<Real>{20, 30});
  CHECK(measures(R"({"type": "drag", "stencils": [[0, 1, 2]], "stiffness": )" + map + "}") == std::vector<Real>{20});
  const std::vector<Real> triangles = measures(R"({"type": "triangle_strain", "stiffness": )" + map + "}");
  CHECK(triangles[0] == doctest::Approx(0.5 * (10 + 20 + 20) / 3));  // area 1/2 of the triangle 0 1 4
}

TEST_CASE("masses from a map") {
  const Files files;
  const Scene scene = files.load("strip.ply", "", R"({"each": {"map": {"name": "weight"}, "from": 1, "to": 3}})");
  CHECK(scene.simulation.state().masses == std::vector<Real>{1, 2, 3, 1, 2, 3});
}

TEST_CASE("maps that do not fit an option") {
  const Files files;
  const auto error = [&](const std::string& stiffness) {
    return files.message_of("strip.ply",
                            R"(, "constraints": [{"type": "edge_spring", "stiffness": )" + stiffness + "}]");
  };
  const std::string place = "s.json: bodies[0].constraints[0].stiffness";
  CHECK(error(R"({"map": {"name": "weight"}})").starts_with(place + ": at vertex 0: 0 is out of range"));
  CHECK(error(R"({"map": {"file": "negative.txt"}})").starts_with(place + ": at vertex 3: -1 is out of range"));
  CHECK(error(R"({"map": {"file": "negative.txt"}, "from": 1, "to": 2})").find("has -1 at vertex 3") !=
        std::string::npos);
  CHECK(error(R"({"map": {"name": "weight"}, "from": 1})").starts_with(place + ": the key 'to' is missing"));
  CHECK(error(R"({"map": {"name": "weight"}, "form": 1})").starts_with(place + ".form: unknown key"));
  CHECK(error(R"({"mpa": 1})").starts_with(place + ".mpa: unknown key"));
  CHECK(error(R"({"map": 3})").starts_with(place + ".map: found a number; give an object"));
  CHECK(files.message_of("strip.ply", "", R"({"each": {"map": {"name": "weight"}}})")
            .starts_with("s.json: bodies[0].mass"));
}

TEST_CASE("meshes of every format, scaled and turned") {
  const Files files;
  const auto top = [&](const std::string& mesh) {
    const Scene scene = parse_scene(R"({"pliant": 1, "bodies": [{"mesh": )" + mesh + R"(, "mass": {"total": 1}}]})",
                                    files.folder.path(), "s.json");
    return row(scene.simulation.bodies()[0].mesh.vertices, 5);
  };
  CHECK(top(R"({"file": "strip.ply"})") == Vec3(2, 1, 0));
  CHECK(top(R"({"file": "strip.ply", "scale": 0.5, "up": "y"})") == Vec3(1, 0, 0.5));
  CHECK(files.message_of("strip.txt", "").find("known: .obj, .ply") != std::string::npos);
}

}  // namespace

TEST_CASE("stiffness factors: lists and maps, for groups of materials and of one's own") {
  const Files files;
  const auto measures = [&](const std::string& factors, const std::string& group) {
    const Scene scene = files.load("strip.ply", R"(, "constraints": [{"type": "edge_spring"}], "stiffness_factors": )" +
                                                    factors + R"(, "material": "cotton", "name": "strip")");
    const auto& batches = scene.simulation.groups().at(scene.simulation.find_group(group).value()).set.batches;
    return std::vector<Real>(batches[0]->rest_measure().begin(), batches[0]->rest_measure().end());
  };
  for (const std::string group : {"strip.edge_spring", "strip.warp"}) {
    const std::vector<Real> plain = measures("{}", group);
    const std::vector<Real> tripled = measures("{\"" + group + "\": [3, 3, 3, 3, 3, 3]}", group);
    const std::vector<Real> mapped =
        measures("{\"" + group + R"(": {"map": {"name": "weight"}, "from": 2, "to": 4}})", group);
    REQUIRE(tripled.size() == plain.size());
    Real least = 100, most = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      CHECK(tripled[i] == doctest::Approx(3 * plain[i]));
      least = std::min(least, mapped[i] / plain[i]);
      most = std::max(most, mapped[i] / plain[i]);
    }
    CHECK(least >= 2);
    CHECK(least < 2.7);
    CHECK(most <= 4);
    CHECK(most > 3.3);
  }
  const std::string springs = R"(, "constraints": [{"type": "edge_spring"}, {"type": "position", "on": [0]}])";
  const auto message = [&](const std::string& factors) {
    return files.message_of("strip.ply", springs + R"(, "stiffness_factors": )" + factors);
  };
  CHECK(message(R"({"body 0.edge_sprin": [1, 1, 1, 1, 1, 1]})") ==
        "s.json: bodies[0].stiffness_factors.body 0.edge_sprin: 'body 0.edge_sprin' is no group of the body 'body 0' "
        "that takes factors; did you mean 'body 0.edge_spring'? (known: body 0.edge_spring, body 0.position)");
  CHECK(message(R"({"body 0.position": [1, 1, 1, 1, 1, 1]})") == "(no error)");  // for when they are soft
  CHECK(message(R"({"body 0.edge_spring": [1, 1]})") ==
        "s.json: bodies[0].stiffness_factors.body 0.edge_spring: the list has 2 entries; give 6 (one a vertex), or an "
        "object "
        "with a map");
  CHECK(message(R"({"body 0.edge_spring": [1, 1, 0, 1, 1, 1]})").find("at vertex 2 is 0; give") != std::string::npos);
  CHECK(message(R"({"body 0.edge_spring": {"map": {"file": "negative.txt"}}})").find("at vertex 3 is -1; give") !=
        std::string::npos);
  CHECK(message("[1]") != "(no error)");
}

}  // namespace test_maps
