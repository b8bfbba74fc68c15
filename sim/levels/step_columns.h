// The columns of steps.csv. A column is a member of StepRow or ReferenceError and a line of all_step_columns;
// the writer and the reader of the file, statistics, report and docs walk these lines.
#pragma once

#include "sim/levels/column_form.h"

namespace hopmesh::levels {

/// In the order of the file.
inline constexpr StepColumn all_step_columns[] = {
    StepColumn("step", "", "from 0", &StepRow::step, Subject::motion),
    StepColumn("time", "s", "at the step's end", &StepRow::time, Subject::motion),
    StepColumn("sweeps", "", "of the network, all expansions together", &StepRow::sweeps, Subject::relaxation,
               Curve{"sweeps a step"}, Total{Summary::sum, "sweeps", "sweeps", "{}"}),
    StepColumn("cycles", "cycles", "of the array, from START taken to DONE; 0 at level reference",
               &StepRow::cycles, Subject::clock, Curve{"array cycles a step"},
               Total{Summary::sum, "array_cycles"}),
    StepColumn(
        "energy", "J",
        "Σ α (length − rest length)², or Σ α √(length² + floor²) where `mesh.springs.law = \"tension\"`",
        &StepRow::energy, Subject::motion, Curve{"elastic energy", "J"}),
    StepColumn("kinetic", "J", "Σ ½ m v²", &StepRow::kinetic, Subject::motion, Curve{"kinetic energy", "J"}),
    StepColumn("max_strain", "", "largest |length / rest length − 1|", &StepRow::max_strain, Subject::motion,
               Curve{"largest strain", "%", 100},
               Total{Summary::largest, "largest_strain", "largest strain", "{:.1f} %", 100}),
    StepColumn("saturated", "", "outputs at rest at +1 or −1", &StepRow::saturated, Subject::relaxation,
               Curve{"outputs at +1 or -1"}),
    StepColumn("converged", "", "1: the threshold was met; 0: stopped by `relax.max_sweeps`",
               &StepRow::converged, Subject::relaxation, {},
               Total{Summary::unmet, "steps_stopped_by_max_sweeps", "steps stopped by max_sweeps", "{}"}),
    StepColumn(
        "input_left", "",
        "largest |s| of neurons that may still move when the step ends, over the largest |I|: 0 at rest",
        &StepRow::input_left, Subject::relaxation, Curve{"input left at the end of a step"}),
    StepColumn("fall_left", "",
               "what the network's energy would still fall by in double, over the step's whole fall",
               &StepRow::fall_left, Subject::rest, Curve{"fall left at the end of a step"},
               Total{Summary::median, "median_fall_left", "fall left by a step", "{:.2g} (median)"},
               Total{Summary::largest, "largest_fall_left", "largest fall left", "{:.2g} of a step's"}),
    StepColumn(
        "fall_seen", "",
        "of that, what the host's own look finds in every eighth step: at least so much is left",
        &StepRow::fall_seen, Subject::glance, {},
        Total{Summary::median, "median_fall_seen", "fall left, host's look", "{:.2g} (median)"},
        Total{Summary::largest, "largest_fall_seen", "largest fall, host's look", "{:.2g} of a step's"}),
    StepColumn("max_stretch", "",
               "largest length / rest length (length as built where the rest length is 0); a run ends at 10",
               &StepRow::max_stretch, Subject::motion),
    StepColumn("bus_cycles", "cycles", "that the host held the bus", &StepRow::bus_cycles, Subject::clock, {},
               Total{Summary::sum, "bus_cycles"}),
    StepColumn("clipped", "", "weights and biases of the step that did not fit their format",
               &StepRow::clipped, Subject::network, {},
               Total{Summary::sum, "clipped", "weights and biases clipped", "{}"}),
    StepColumn("vanished", "", "weights and biases of the step, not 0, that their format rounds to 0",
               &StepRow::vanished, Subject::network, {},
               Total{Summary::sum, "vanished", "weights and biases that vanish", "{}"}),
    StepColumn("output_error", "",
               "largest |V − V at rest|, of the reference brought to rest on the very same step",
               &ReferenceError::largest_output, Subject::reference,
               Curve{"largest output error against the reference's rest"},
               Total{Summary::largest, "largest_output_error", "largest output error", "{:.3g}"}),
    StepColumn(
        "output_error_rms", "", "root mean square over neurons of that difference",
        &ReferenceError::rms_output, Subject::reference, {},
        Total{Summary::median, "median_output_error_rms", "output error of a step", "{:.3g} rms (median)"}),
    StepColumn("rounding_error", "",
               "the words' part of it: rms of V against the reference after as many sweeps as the array did",
               &ReferenceError::rounding, Subject::reference, {},
               Total{Summary::median, "median_rounding_error", "of it by rounding", "{:.3g} rms (median)"}),
    StepColumn("stopping_error", "",
               "the part of where the step stopped: rms of the reference after these sweeps against its rest",
               &ReferenceError::stopping, Subject::reference, {},
               Total{Summary::median, "median_stopping_error", "of it by stopping", "{:.3g} rms (median)"}),
    StepColumn(
        "energy_gap", "", "energy left above the reference's rest, as a part of the step's fall",
        &ReferenceError::energy_gap, Subject::reference,
        Curve{"energy left above the reference's rest", "of its fall"},
        Total{Summary::median, "median_energy_gap", "energy left of a step's fall", "{:.3g} (median)"},
        Total{Summary::largest, "largest_energy_gap", "largest energy left", "{:.3g} of a step's fall"}),
    StepColumn("network_error", "",
               "largest difference of a weight or bias (before rounding) from the reference's, over the "
               "largest of them",
               &ReferenceError::network, Subject::reference, {},
               Total{Summary::largest, "largest_network_error", "largest weight or bias error",
                     "{:.2g} of the largest"}),
    StepColumn("refinements", "", "corrections of the array's answer that were kept (`relax.refinements`)",
               &StepRow::refinements, Subject::correction, {},
               Total{Summary::sum, "refinements", "corrections", "{}"}),
    StepColumn("refused", "",
               "corrections that were not, since the network's energy would have risen: the step keeps the "
               "answer before",
               &StepRow::refused, Subject::correction, {},
               Total{Summary::sum, "refinements_refused", "corrections refused", "{}"}),
    StepColumn(
        "residual", "",
        "what they leave, from the mesh in double: largest |s| of neurons that may still move, over the "
        "largest |I|",
        &StepRow::residual, Subject::correction, Curve{"residual at the end of a step"},
        Total{Summary::median, "median_residual", "residual of a step", "{:.2g} (median)"},
        Total{Summary::largest, "largest_residual", "largest residual", "{:.2g}"}),
    StepColumn("told_error", "",
               "output_error_rms as a single solve with the residual tells it, without a rest (definite "
               "networks, every eighth step); an estimate where outputs are held at bounds",
               &StepRow::told_error, Subject::certainty, {},
               Total{Summary::median, "median_told_error", "output error as one solve tells it",
                     "{:.3g} rms (median)"}),
    StepColumn("error_bound", "",
               "more than output_error_rms cannot be, as formats and the stop say beforehand (definite "
               "networks, every eighth step; not where answers are corrected)",
               &StepRow::error_bound, Subject::certainty, {},
               Total{Summary::median, "median_error_bound", "output error is at most, beforehand",
                     "{:.3g} rms (median)"}),
    StepColumn(
        "host_error", "",
        "of a host that computes in whole numbers (`host.arithmetic`): rms of V at rest in its network, "
        "before rounding, against the reference's",
        &StepRow::host_error, Subject::arithmetic, {},
        Total{Summary::median, "median_host_error", "of it by the host's whole numbers",
              "{:.3g} rms (median)"}),
    StepColumn("instructions", "", "of the host, where an emulated one counts them (`host.processor`)",
               &StepRow::instructions, Subject::host, Curve{"host's instructions a step"},
               Total{Summary::sum, "instructions", "host's instructions", "{:.4g}"}),
    StepColumn("hash", "", "of positions, velocities, accelerations and outputs (XXH64)",
               HashFigure{&StepRow::hash}, Subject::motion),
};

} // namespace hopmesh::levels
