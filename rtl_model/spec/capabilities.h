// What an array says of itself in its capability registers. Here the firmware's register table and the
// description of the array meet, so here both are held to one numbering.
#pragma once

#include "rtl_model/spec/memory_map.h"
#include "rtl_model/spec/relaxation.h"

namespace hopmesh::spec {

namespace detail {

template <typename Mode> constexpr bool numbered(int word, Mode mode) {
  return word == static_cast<int>(mode);
}

static_assert(numbered(HM_SCHEDULE_COLOURED, Schedule::coloured));
static_assert(numbered(HM_SCHEDULE_SEQUENTIAL, Schedule::sequential));
static_assert(numbered(HM_SCHEDULE_SYNCHRONOUS, Schedule::synchronous));
static_assert(schedule_names.size() == HM_SCHEDULE_SYNCHRONOUS + 1);

static_assert(numbered(HM_NORMALISER_PRESCALED, Normaliser::prescaled));
static_assert(numbered(HM_NORMALISER_RECIPROCAL, Normaliser::reciprocal));
static_assert(numbered(HM_NORMALISER_DIVIDER, Normaliser::divider));
static_assert(normaliser_names.size() == HM_NORMALISER_DIVIDER + 1);

static_assert(numbered(HM_OUTPUT_MODIFIED, Output::modified));
static_assert(numbered(HM_OUTPUT_BINARY, Output::binary));
static_assert(numbered(HM_OUTPUT_PROJECTED, Output::projected));
static_assert(numbered(HM_OUTPUT_MOMENTUM, Output::momentum));
static_assert(output_names.size() == HM_OUTPUT_MOMENTUM + 1);

static_assert(numbered(HM_STAGES_EACH, Stages::each));
static_assert(numbered(HM_STAGES_ONE, Stages::one));
static_assert(stages_names.size() == HM_STAGES_ONE + 1);

static_assert(numbered(HM_RND, Rounding::rnd));
static_assert(numbered(HM_RND_ZERO, Rounding::rnd_zero));
static_assert(numbered(HM_RND_MIN_INF, Rounding::rnd_min_inf));
static_assert(numbered(HM_RND_INF, Rounding::rnd_inf));
static_assert(numbered(HM_RND_CONV, Rounding::rnd_conv));
static_assert(numbered(HM_TRN, Rounding::trn));
static_assert(numbered(HM_TRN_ZERO, Rounding::trn_zero));
static_assert(rounding_names.size() == HM_TRN_ZERO + 1);

static_assert(numbered(HM_SAT, Overflow::sat));
static_assert(numbered(HM_SAT_ZERO, Overflow::sat_zero));
static_assert(numbered(HM_SAT_SYM, Overflow::sat_sym));
static_assert(numbered(HM_WRAP, Overflow::wrap));
static_assert(overflow_names.size() == HM_WRAP + 1);

} // namespace detail

/// A format as a register holds it: width | integer bits << 8 | rounding << 16 | overflow << 24. The driver
/// takes it apart (firmware/driver.c).
inline std::uint32_t format_word(const NumberFormat& f) {
  return static_cast<std::uint32_t>(f.width) | (static_cast<std::uint32_t>(f.integer_bits) & 255) << 8 |
         static_cast<std::uint32_t>(f.rounding) << 16 | static_cast<std::uint32_t>(f.overflow) << 24;
}

/// How many codes share a word of each window that could pack them.
inline std::uint32_t packing_word(const MemoryMap& map) {
  const auto codes = [&map](Window w) { return static_cast<std::uint32_t>(map[w].codes_a_word); };
  return codes(Window::BIAS) << HM_SHIFT_CAP_PACKING_BIAS |
         codes(Window::OUTPUT) << HM_SHIFT_CAP_PACKING_OUTPUT |
         codes(Window::WEIGHT) << HM_SHIFT_CAP_PACKING_WEIGHT |
         codes(Window::MOMENTUM) << HM_SHIFT_CAP_PACKING_MOMENTUM;
}

/// STOP as a host writes it.
inline std::uint32_t stop_word(const StopRule& rule) {
  return static_cast<std::uint32_t>(rule.by_sum) << HM_SHIFT_STOP_BY_SUM |
         static_cast<std::uint32_t>(rule.share) << HM_SHIFT_STOP_SHARE;
}

struct RegisterWord {
  std::uint32_t offset, word;
};

/// Every capability register of an array built for a topology; `phases`: of a sweep.
inline std::vector<RegisterWord> capability_words(const ArraySpec& a, const Topology& t, std::size_t phases) {
  const auto word = [](auto value) { return static_cast<std::uint32_t>(value); };
  const MemoryMap map = memory_map(a, t);
  const Formats f = built_formats(a, t.most_taps());
  return {{HM_REG_CAP_CELLS, word(t.cells())},
          {HM_REG_CAP_NEURONS_PER_CELL, word(t.neurons_per_cell)},
          {HM_REG_CAP_LINK_WORDS, word(t.link_to.size())},
          {HM_REG_CAP_WEIGHT_WORDS, word(map[Window::WEIGHT].words())},
          {HM_REG_CAP_PHASES, word(phases)},
          {HM_REG_CAP_SCHEDULE, word(a.schedule)},
          {HM_REG_CAP_NORMALISER, word(a.normaliser)},
          {HM_REG_CAP_RECIPROCAL_BITS, word(a.reciprocal_bits)},
          {HM_REG_CAP_LANES, word(a.lanes)},
          {HM_REG_CAP_BUS_BITS, word(a.bus_bits)},
          {HM_REG_CAP_FORMAT_WEIGHT, format_word(f.weight)},
          {HM_REG_CAP_FORMAT_BIAS, format_word(f.bias)},
          {HM_REG_CAP_FORMAT_DRIVE, format_word(f.drive)},
          {HM_REG_CAP_FORMAT_STATE, format_word(f.state)},
          {HM_REG_CAP_FORMAT_LINK, format_word(f.link)},
          {HM_REG_CAP_FORMAT_ACCUMULATOR, format_word(f.accumulator)},
          {HM_REG_CAP_OUTPUT, word(a.output)},
          {HM_REG_CAP_ELEMENTS, word(a.elements)},
          {HM_REG_CAP_STAGES, word(a.stages)},
          {HM_REG_CAP_PIPELINE, word(a.pipeline)},
          {HM_REG_CAP_PACKING, packing_word(map)},
          {HM_REG_CAP_MOMENTUM_WORDS, word(map[Window::MOMENTUM].words())},
          {HM_REG_CAP_SPAN, word(map.span)},
          {HM_REG_CAP_WINDOW_FIRST_LINK, word(map[Window::FIRST_LINK].offset)},
          {HM_REG_CAP_WINDOW_LINK, word(map[Window::LINK].offset)},
          {HM_REG_CAP_WINDOW_BIAS, word(map[Window::BIAS].offset)},
          {HM_REG_CAP_WINDOW_OUTPUT, word(map[Window::OUTPUT].offset)},
          {HM_REG_CAP_WINDOW_WEIGHT, word(map[Window::WEIGHT].offset)},
          {HM_REG_CAP_WINDOW_MOMENTUM, word(map[Window::MOMENTUM].offset)},
          {HM_REG_CAP_RELAXATION, word(a.output == Output::projected ? a.relaxation : 0)}};
}

} // namespace hopmesh::spec
