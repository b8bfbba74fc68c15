/* From doubles to raw codes and back, over the bus. Registers and windows: docs/hardware/registers.md. */
#include "firmware/doubles.h"
#include "firmware/driver_parts.h"

uint32_t hm_driver_places(const hm_driver* d, double threshold) {
  const hm_format places = {32, 32 - hm_fraction_bits(&d->state), HM_TRN_ZERO, HM_SAT};
  int clipped;
  return (uint32_t)hm_quantise(threshold, 0, &places, &clipped);
}

/* ---- what stands behind the bus ---- */

static int expect(const hm_driver* d, uint32_t offset, uint32_t wanted, int otherwise) {
  uint32_t word;
  TRY(hm_read_register(d, offset, &word));
  return word == wanted ? HM_OK : otherwise;
}

/* The window that begins where this register says. */
static int expect_words(const hm_driver* d, uint32_t offset_register, const uint32_t* wanted,
                        uint32_t count) {
  const hm_line* line = &d->line;
  uint32_t offset;
  TRY(hm_read_register(d, offset_register, &offset));
  for (uint32_t done = 0; done < count;) {
    const uint32_t part = count - done < line->buffer_words ? count - done : line->buffer_words;
    TRY(line->bus->read_burst(line->bus->context, offset + 4 * done, line->buffer, part));
    for (uint32_t k = 0; k < part; ++k)
      if (line->buffer[k] != wanted[done + k]) return HM_ERROR_MESH;
    done += part;
  }
  return HM_OK;
}

static int expect_mesh(const hm_driver* d, const hm_mesh* mesh) {
  const uint32_t links = mesh->first_link[mesh->cells];
  TRY(expect(d, HM_REG_CAP_CELLS, mesh->cells, HM_ERROR_MESH));
  TRY(expect(d, HM_REG_CAP_NEURONS_PER_CELL, mesh->components, HM_ERROR_MESH));
  TRY(expect(d, HM_REG_CAP_LINK_WORDS, links, HM_ERROR_MESH));
  TRY(expect_words(d, HM_REG_CAP_WINDOW_FIRST_LINK, mesh->first_link, mesh->cells + 1));
  return expect_words(d, HM_REG_CAP_WINDOW_LINK, mesh->link_to, links);
}

static int find_window(const hm_driver* d, uint32_t offset_register, uint32_t codes_a_word,
                       hm_window* window) {
  window->codes_a_word = codes_a_word;
  if (codes_a_word != 1 && codes_a_word != 2 && codes_a_word != 4) return HM_ERROR_ID;
  return hm_read_register(d, offset_register, &window->offset);
}

static int find_windows(hm_driver* d) {
  uint32_t packing;
  TRY(hm_read_register(d, HM_REG_CAP_PACKING, &packing));
  TRY(find_window(d, HM_REG_CAP_WINDOW_BIAS, HM_FIELD(packing, CAP_PACKING_BIAS), &d->biases));
  TRY(find_window(d, HM_REG_CAP_WINDOW_OUTPUT, HM_FIELD(packing, CAP_PACKING_OUTPUT), &d->outputs));
  return find_window(d, HM_REG_CAP_WINDOW_WEIGHT, HM_FIELD(packing, CAP_PACKING_WEIGHT), &d->weights);
}

/* A minor version only adds what a driver need not know. */
static int expect_version(hm_driver* d) {
  TRY(hm_read_register(d, HM_REG_VERSION, &d->version));
  return HM_FIELD(d->version, VERSION_MAJOR) == HM_VERSION_MAJOR ? HM_OK : HM_ERROR_VERSION;
}

static int look_at(hm_driver* d, const hm_mesh* mesh) {
  TRY(expect(d, HM_REG_ID, HM_ID_VALUE, HM_ERROR_ID));
  TRY(expect_version(d));
  TRY(expect_mesh(d, mesh));
  TRY(find_windows(d));
  TRY(hm_read_register(d, HM_REG_CAP_NORMALISER, &d->normaliser));
  TRY(hm_read_register(d, HM_REG_CAP_OUTPUT, &d->output));
  TRY(hm_read_format(d, HM_REG_CAP_FORMAT_WEIGHT, &d->weight));
  TRY(hm_read_format(d, HM_REG_CAP_FORMAT_BIAS, &d->bias));
  TRY(hm_read_format(d, HM_REG_CAP_FORMAT_STATE, &d->state));
  if (d->output == HM_OUTPUT_MOMENTUM) TRY(hm_driver_open_momentum(d));
  return hm_write_register(d, HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
}

int hm_driver_open(hm_driver* d, const hm_bus* bus, const hm_mesh* mesh, uint32_t* buffer,
                   uint32_t buffer_words) {
  *d = (hm_driver){.line = {bus, buffer, buffer_words}};
  const int error = buffer_words < 1 ? HM_ERROR_SPACE : look_at(d, mesh);
  if (error != HM_OK) d->line.bus = 0;
  return error;
}

/* ---- loading a network ---- */

typedef union double_bits { /* C11, 6.5.2.3: both read the same bytes */
  double value;
  uint64_t bits;
} double_bits;

static uint64_t larger(uint64_t largest, double value) {
  const double_bits x = {.value = value};
  const uint64_t bits = x.bits & INT64_MAX;
  return bits > largest ? bits : largest;
}

/* The bits of the largest magnitude. As whole numbers they are in the order of the values, and infinities and
   what is no number come last: one look tells the largest value and whether all are finite. Four in turn, so
   that no look waits for the one before it. */
static uint64_t largest_bits(const double* values, uint32_t count) {
  uint64_t a = 0, b = 0, c = 0, d = 0;
  uint32_t k = 0;
  for (; k + 4 <= count; k += 4) {
    a = larger(a, values[k]);
    b = larger(b, values[k + 1]);
    c = larger(c, values[k + 2]);
    d = larger(d, values[k + 3]);
  }
  for (; k < count; ++k) a = larger(a, values[k]);
  a = a > b ? a : b;
  c = c > d ? c : d;
  return a > c ? a : c;
}

static int is_finite(uint64_t largest) {
  return largest < 0x7FF0000000000000u;
}

static double value_of(uint64_t bits) {
  return (double_bits){.bits = bits}.value;
}

/* A single power of two for the whole network: W stays symmetric, and u = s / N does not see it. */
static int block_exponent(const hm_driver* d, double w, double b) {
  if (w == 0 && b == 0) return 0;
  if (w == 0) return hm_room(b, &d->bias);
  if (b == 0) return hm_room(w, &d->weight);
  const int for_weights = hm_room(w, &d->weight), for_biases = hm_room(b, &d->bias);
  return for_weights < for_biases ? for_weights : for_biases;
}

/* What a prescaled row is divided by: N = sum |w| + |I|, or 1 for an empty row. */
static double row_norm(const hm_mesh* mesh, const hm_network* network, uint32_t cell, uint32_t p) {
  const double* row = network->weight + hm_row_offset(mesh, cell, p);
  const uint32_t length = hm_row_length(mesh, cell);
  double norm = hm_magnitude(network->bias[cell * mesh->components + p]);
  for (uint32_t k = 0; k < length; ++k) norm += hm_magnitude(row[k]);
  return norm > 0 ? norm : 1;
}

static int end_counted(hm_driver* d, hm_stream* stream) {
  d->clipped += stream->clipped;
  d->vanished += stream->vanished;
  return hm_stream_end(stream);
}

/* Rows lie one behind the other, as the window has them. */
static int load_weights(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  hm_stream weights = hm_stream_open(&d->line, &d->weights, &d->weight, shift);
  TRY(hm_stream_put(&weights, network->weight, hm_weight_count(mesh)));
  return end_counted(d, &weights);
}

static int load_biases(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  hm_stream biases = hm_stream_open(&d->line, &d->biases, &d->bias, shift);
  TRY(hm_stream_put(&biases, network->bias, hm_neuron_count(mesh)));
  return end_counted(d, &biases);
}

static int load_prescaled_weights(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  hm_stream weights = hm_stream_open(&d->line, &d->weights, &d->weight, 0);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      TRY(hm_stream_put_row(&weights, network->weight + hm_row_offset(mesh, c, p), hm_row_length(mesh, c),
                            row_norm(mesh, network, c, p)));
  return end_counted(d, &weights);
}

static int load_prescaled_biases(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  hm_stream biases = hm_stream_open(&d->line, &d->biases, &d->bias, 0);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      TRY(hm_stream_put_row(&biases, network->bias + c * mesh->components + p, 1,
                            row_norm(mesh, network, c, p)));
  return end_counted(d, &biases);
}

/* Only the sign of a binary neuron's s counts: no row is divided, and W stays symmetric. */
int hm_driver_prescales(const hm_driver* d) {
  return d->output == HM_OUTPUT_MODIFIED && d->normaliser == HM_NORMALISER_PRESCALED;
}

static int load_rows(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  if (hm_driver_prescales(d)) {
    TRY(load_prescaled_weights(d, mesh, network));
    return load_prescaled_biases(d, mesh, network);
  }
  TRY(load_weights(d, mesh, network, shift));
  return load_biases(d, mesh, network, shift);
}

/* An output is never scaled: it cannot clip what the network says. */
static int load_outputs(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  hm_stream outputs = hm_stream_open(&d->line, &d->outputs, &d->state, 0);
  TRY(hm_stream_put(&outputs, network->output, hm_neuron_count(mesh)));
  return hm_stream_end(&outputs);
}

/* ---- one relaxation ---- */

int hm_driver_start(const hm_driver* d, uint32_t threshold, uint32_t max_sweeps) {
  TRY(hm_write_register(d, HM_REG_THRESHOLD, threshold));
  TRY(hm_write_register(d, HM_REG_MAX_SWEEPS, max_sweeps));
  TRY(hm_write_register(d, HM_REG_IRQ_STATUS, HM_IRQ_DONE)); /* left over from a run that nobody waited for */
  TRY(hm_write_register(d, HM_REG_CONTROL, HM_CONTROL_START));
  TRY(d->line.bus->wait(d->line.bus->context));
  return hm_write_register(d, HM_REG_IRQ_STATUS, HM_IRQ_DONE);
}

int hm_driver_read_counters(const hm_driver* d, hm_relaxation* result) {
  uint32_t status, low, high;
  TRY(hm_read_register(d, HM_REG_STATUS, &status));
  if (!(status & HM_STATUS_DONE)) return HM_ERROR_BUSY;
  TRY(hm_read_register(d, HM_REG_SWEEPS, &result->sweeps));
  TRY(hm_read_register(d, HM_REG_CYCLES_LO, &low));
  TRY(hm_read_register(d, HM_REG_CYCLES_HI, &high));
  result->converged = (status & HM_STATUS_CONVERGED) != 0;
  result->cycles = (uint64_t)high << 32 | low;
  return HM_OK;
}

static int read_outputs(const hm_driver* d, const hm_mesh* mesh, hm_network* network) {
  const double last_place = 1 / hm_power_of_two(hm_fraction_bits(&d->state));
  return hm_window_read(&d->line, &d->outputs, last_place, network->output, hm_neuron_count(mesh));
}

int hm_driver_expect_idle(const hm_driver* d) {
  uint32_t status;
  TRY(hm_read_register(d, HM_REG_STATUS, &status));
  return status & HM_STATUS_BUSY ? HM_ERROR_BUSY : HM_OK;
}

static int run(const hm_driver* d, const hm_mesh* mesh, hm_network* network, double threshold,
               uint32_t max_sweeps, hm_relaxation* result) {
  TRY(hm_driver_start(d, hm_driver_places(d, threshold), max_sweeps));
  TRY(hm_driver_read_counters(d, result));
  return read_outputs(d, mesh, network);
}

int hm_driver_relax(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                    uint32_t max_sweeps, hm_relaxation* result) {
  hm_driver* d = driver;
  const uint32_t neurons = hm_neuron_count(mesh);
  const uint64_t weight = largest_bits(network->weight, hm_weight_count(mesh));
  const uint64_t bias = largest_bits(network->bias, neurons);
  if (!is_finite(weight) || !is_finite(bias) || !is_finite(largest_bits(network->output, neurons)))
    return HM_ERROR_NUMBER;
  d->shift = hm_driver_prescales(d) ? 0 : block_exponent(d, value_of(weight), value_of(bias));
  d->clipped = d->vanished = 0;
  TRY(hm_driver_expect_idle(d));
  TRY(load_rows(d, mesh, network, d->shift));
  TRY(load_outputs(d, mesh, network));
  TRY(hm_driver_write_stop(d, mesh, network));
  return run(d, mesh, network, threshold, max_sweeps, result);
}

/* Of a residual much vanishes wherever it is done with: that tells nothing of the network. */
int hm_driver_correct(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                      uint32_t max_sweeps, hm_relaxation* result) {
  hm_driver* d = driver;
  const uint32_t neurons = hm_neuron_count(mesh), vanished = d->vanished;
  if (!is_finite(largest_bits(network->bias, neurons)) || !is_finite(largest_bits(network->output, neurons)))
    return HM_ERROR_NUMBER;
  TRY(hm_driver_expect_idle(d));
  TRY(load_biases(d, mesh, network, d->shift));
  d->vanished = vanished;
  TRY(load_outputs(d, mesh, network));
  return run(d, mesh, network, threshold, max_sweeps, result);
}

double hm_driver_room(void* driver) {
  const hm_driver* d = driver;
  return hm_largest_value(&d->bias) * hm_power_of_two(-d->shift);
}

int hm_driver_restore(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  d->shift = shift;
  TRY(hm_driver_expect_idle(d));
  TRY(load_weights(d, mesh, network, shift));
  return hm_driver_write_stop(d, mesh, network);
}
