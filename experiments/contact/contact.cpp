#include "contact/contact.h"

#include "contact/contact_convergence.h"
#include "contact/contact_cost.h"
#include "contact/crossing_counts.h"
#include "contact/friction.h"
#include "contact/impact.h"
#include "contact/moving_ground.h"
#include "contact/sheets_on_sheets.h"
#include "contact/surface_cost.h"

namespace pliant_experiments {

pliant_report::Chapter run_contact(const ExperimentContext& context) {
  pliant_report::Chapter chapter;
  chapter.question =
      "Contact with rigid colliders, and between surfaces, is a potential of the distance, friction one of the slide, "
      "both on the same factor. "
      "Is friction right after ten iterations, on a slope, on a conveyor and on a turntable, in both integrators and "
      "in "
      "substeps? How deep do bodies go that hit something fast, and does any vertex pass through? What does L-BFGS "
      "gain, and what do colliders cost? Do surfaces keep out of each other, carry what lies on them, rub as "
      "they should, and at what cost? A sheet has 0.2 kg/m², triangle strain of 1e3 N/m and bending of 1e-5 N m; "
      "h = 1/60 s and 10 iterations, unless said.";
  measure_slope(context, chapter);
  measure_stop(context, chapter);
  measure_conveyor(context, chapter);
  measure_turntable(context, chapter);
  measure_thrown_sheets(context, chapter);
  measure_dropped_block(context, chapter);
  measure_contact_convergence(context, chapter);
  measure_contact_cost(context, chapter);
  measure_crossings(context, chapter);
  measure_layer_loads(context, chapter);
  measure_sheet_on_sheet(context, chapter);
  measure_surface_cost(context, chapter);
  return chapter;
}

}  // namespace pliant_experiments
