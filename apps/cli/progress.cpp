#include "progress.h"

#include <cmath>

#include <fmt/format.h>

#include "terminal.h"

namespace pliant_cli {

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 5400) return fmt::format("{:.0f} min", std::ceil(seconds / 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

Progress::Progress(std::int64_t first, std::int64_t last, Show show)
    : first_(first), last_step_(last), active_(show == Show::on_terminal && has_error_terminal()) {}

void Progress::update(std::int64_t step, double residual) {
  using namespace std::chrono_literals;
  const Clock::time_point now = Clock::now();
  if (!active_ || step <= first_ || now - last_ < 100ms) return;
  last_ = now;
  const double per_step = std::chrono::duration<double>(now - start_).count() / static_cast<double>(step - first_);
  print_to_stderr(fmt::format(
      "\r\x1b[K"
      "step {} of {}   {:.3g} ms a step   residual {:.2e} N   {} left",
      step, last_step_, 1e3 * per_step, residual, duration_text(per_step * static_cast<double>(last_step_ - step))));
  shown_ = true;
}

void Progress::clear() {
  if (!shown_) return;
  print_to_stderr("\r\x1b[K");
  shown_ = false;
}

}  // namespace pliant_cli
