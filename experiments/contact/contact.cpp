#include "contact/contact.h"

#include "contact/contact_convergence.h"
#include "contact/contact_cost.h"
#include "contact/friction.h"
#include "contact/impact.h"
#include "contact/moving_ground.h"

namespace pliant_experiments {

pliant_report::Chapter run_contact(const ExperimentContext& context) {
  pliant_report::Chapter chapter;
  chapter.question =
      "Contact with rigid colliders is a potential of the distance, friction one of the slide, both on the same "
      "factor. "
      "Is friction right after ten iterations, on a slope, on a conveyor and on a turntable, in both integrators and "
      "in "
      "substeps? How deep do bodies go that hit something fast, and does any vertex pass through? What does L-BFGS "
      "gain, and what do colliders cost? A sheet has 0.2 kg/m², triangle strain of 1e3 N/m and bending of 1e-5 N m; "
      "h = 1/60 s and 10 iterations, unless said.";
  measure_slope(context, chapter);
  measure_stop(context, chapter);
  measure_conveyor(context, chapter);
  measure_turntable(context, chapter);
  measure_thrown_sheets(context, chapter);
  measure_dropped_block(context, chapter);
  measure_contact_convergence(context, chapter);
  measure_contact_cost(context, chapter);
  return chapter;
}

}  // namespace pliant_experiments
