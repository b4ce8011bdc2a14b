#pragma once
// The sub-commands of `pliant`, one file each. A sub-command adds itself to the program and, when it is chosen, leaves
// its exit code in `exit_code`; errors are thrown to main.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace pliant_cli {

/// Whether bench, sweep, experiment and plot are part of the program (PLIANT_BUILD_STUDIES).
inline constexpr bool has_studies = PLIANT_HAS_STUDIES;
inline constexpr std::array<std::string_view, 4> study_commands = {"bench", "sweep", "experiment", "plot"};

inline constexpr int exit_differs = 5;
inline constexpr int exit_interrupted = 130;
inline constexpr std::size_t message_limit = 900;  // bytes of a message on the terminal

/// Names of all experiments; there only with the studies.
std::vector<std::string> experiment_names();

void add_completion_command(CLI::App& program);
void add_man_command(CLI::App& program);
void add_bench_command(CLI::App& program);
void add_convert_command(CLI::App& program);
void add_experiment_command(CLI::App& program, int& exit_code);
void add_info_command(CLI::App& program);
void add_plot_command(CLI::App& program);
void add_render_command(CLI::App& program, int& exit_code);
void add_view_command(CLI::App& program, int& exit_code);
void add_replay_command(CLI::App& program, int& exit_code);
void add_resume_command(CLI::App& program, int& exit_code);
void add_run_command(CLI::App& program, int& exit_code);
void add_sweep_command(CLI::App& program, int& exit_code);
void add_materials_command(CLI::App& program);
void add_scenes_command(CLI::App& program);
void add_check_command(CLI::App& program);
void add_schema_command(CLI::App& program);

}  // namespace pliant_cli
