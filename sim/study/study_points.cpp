#include "sim/study/study_points.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/files/running_check.h"
#include "sim/input/command_words.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

std::string command_of(const Study& study, const Point& point) {
  const std::string words = input::text_of({study.scene, study.array, point.overrides});
  return fmt::format("hopmesh run {} --level {}", words, point.method);
}

/// The place on each axis that a point stands for.
std::vector<const AxisPlace*> places_of(const Study& study, std::size_t number) {
  std::vector<const AxisPlace*> places(study.axes.size());
  for (std::size_t a = study.axes.size(); a-- > 0;) {
    const auto& all = study.axes[a].places;
    places[a] = &all[number % all.size()];
    number /= all.size();
  }
  return places;
}

/// {AXIS} in a value stands for the label of the point's place on that axis.
std::string with_labels(std::string text, const Study& study, const std::vector<const AxisPlace*>& places) {
  for (std::size_t a = 0; a < places.size(); ++a) {
    const std::string mark = '{' + study.axes[a].name + '}', &label = places[a]->label;
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + label.size()))
      text.replace(at, mark.size(), label);
  }
  return text;
}

// "--set: KEY: ..." is told by the study's line that set the key.
input::InputError placed(const Study& study, std::size_t number, const std::string& what) {
  const std::string by_override = "--set: ";
  if (what.rfind(by_override, 0) != 0) return input::InputError(what);
  const std::string rest = what.substr(by_override.size());
  for (const AxisPlace* place : places_of(study, number))
    for (const StudySetting& s : place->settings)
      if (rest.rfind(s.key, 0) == 0)
        return input::InputError(fmt::format("{}:{}: {}", study.path, s.line, rest));
  return input::InputError(study.path + ": " + rest);
}

void check_method(const Study& study, const std::string& name, int line, const std::string& key,
                  const Methods& methods) {
  if (std::find(methods.names.begin(), methods.names.end(), name) == methods.names.end())
    throw input::input_error(study.path, line, key, input::in_quotes(name),
                             fmt::format("{}", fmt::join(methods.names, ", ")),
                             input::nearest_name(name, methods.names));
}

void check_methods(const Study& study, const Methods& methods) {
  for (const std::string& name : study.methods)
    check_method(study, name, study.methods_line, "methods", methods);
  for (const StudyAxis& axis : study.axes)
    for (const AxisPlace& place : axis.places)
      if (place.method_line > 0)
        check_method(study, place.method, place.method_line, "axes." + axis.name + ".method", methods);
}

void check_times(const Study& study, const scene::MotionKeys& motion) {
  for (double time : study.times) {
    const std::uint64_t step = run::step_of_time(time, motion.time_step);
    if (step < 1 || step > static_cast<std::uint64_t>(motion.steps))
      throw input::input_error(
          study.path, study.times_line, "times", fmt::format("{}", time),
          fmt::format("a time within every point's motion; one lasts {} s in steps of {} s",
                      motion.time_step * static_cast<double>(motion.steps), motion.time_step));
  }
}

void check_point(const Study& study, const Point& point, const scene::Inputs& inputs) {
  const levels::BuiltMesh mesh(inputs.scene);
  if (const auto fault = spec::validate_on(inputs.array, mesh.topology()))
    throw placed(study, point.number,
                 input::input_error("--set", 0, fault->key, fault->found, fault->expected).what());
  check_times(study, inputs.scene.motion);
}

} // namespace

Point point_of(const Study& study, std::size_t number) {
  Point point;
  point.number = number;
  point.method = study.methods[number / (study.combinations() / study.methods.size())];
  const std::vector<const AxisPlace*> places = places_of(study, number);
  for (const AxisPlace* place : places) {
    point.labels.push_back(place->label);
    if (!place->method.empty()) point.method = place->method;
    for (const StudySetting& s : place->settings)
      point.overrides.push_back(s.key + '=' + with_labels(s.text, study, places));
  }
  if (study.steps > 0) point.overrides.push_back(fmt::format("motion.steps={}", study.steps));
  point.command = command_of(study, point);
  return point;
}

scene::Inputs inputs_of(const Study& study, const Point& point) {
  try {
    return scene::read_inputs(study.scene, study.array, point.overrides);
  } catch (const input::InputError& error) {
    throw placed(study, point.number, error.what());
  }
}

std::uint64_t check_points(const Study& study, const Methods& methods) {
  check_methods(study, methods);
  files::RunningCheck check;
  const auto add = [&check](const std::string& text) { check.add(text.data(), text.size() + 1); };
  for (double time : study.times) add(fmt::format("{}", time));
  for (const StudyAxis& axis : study.axes) add(axis.name);
  for (std::size_t n = 0; n < study.combinations(); ++n) {
    const Point point = point_of(study, n);
    const scene::Inputs inputs = inputs_of(study, point);
    check_point(study, point, inputs);
    add(point.method);
    for (const std::string& label : point.labels) add(label);
    add(scene::scene_text(inputs.scene));
    add(input::array_text(inputs.array));
  }
  return check.value();
}

} // namespace hopmesh::study
