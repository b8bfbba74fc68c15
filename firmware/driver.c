/* From doubles to raw codes and back, over the bus. Registers and windows: docs/hardware/registers.md. */
#include "firmware/driver.h"

#include "firmware/doubles.h"
#include "firmware/registers.h"

#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const int error_ = (call);                                                                               \
    if (error_ != HM_OK) return error_;                                                                      \
  } while (0)

static uint32_t whole_places(double threshold, const hm_format* format) {
  const hm_format places = {32, 32 - hm_fraction_bits(format), HM_TRN_ZERO, HM_SAT};
  int clipped;
  return (uint32_t)hm_quantise(threshold, 0, &places, &clipped);
}

/* ---- what stands behind the bus ---- */

static int read_register(const hm_driver* d, uint32_t offset, uint32_t* word) {
  return d->bus->read(d->bus->context, offset, word);
}

static int write_register(const hm_driver* d, uint32_t offset, uint32_t word) {
  return d->bus->write(d->bus->context, offset, word);
}

static int read_format(const hm_driver* d, uint32_t offset, hm_format* format) {
  uint32_t word;
  TRY(read_register(d, offset, &word));
  *format = (hm_format){(int)(word & 255), (int)(int8_t)(word >> 8 & 255), (int)(word >> 16 & 255),
                        (int)(word >> 24)};
  return HM_OK;
}

static int expect(const hm_driver* d, uint32_t offset, uint32_t wanted, int otherwise) {
  uint32_t word;
  TRY(read_register(d, offset, &word));
  return word == wanted ? HM_OK : otherwise;
}

static int expect_window(const hm_driver* d, uint32_t address, const uint32_t* wanted, uint32_t count) {
  for (uint32_t done = 0; done < count;) {
    const uint32_t part = count - done < d->buffer_words ? count - done : d->buffer_words;
    TRY(d->bus->read_burst(d->bus->context, address + 4 * done, d->buffer, part));
    for (uint32_t k = 0; k < part; ++k)
      if (d->buffer[k] != wanted[done + k]) return HM_ERROR_MESH;
    done += part;
  }
  return HM_OK;
}

static int expect_mesh(const hm_driver* d, const hm_mesh* mesh) {
  const uint32_t links = mesh->first_link[mesh->cells];
  TRY(expect(d, HM_REG_CAP_CELLS, mesh->cells, HM_ERROR_MESH));
  TRY(expect(d, HM_REG_CAP_NEURONS_PER_CELL, mesh->components, HM_ERROR_MESH));
  TRY(expect(d, HM_REG_CAP_LINK_WORDS, links, HM_ERROR_MESH));
  TRY(expect_window(d, HM_WINDOW_FIRST_LINK, mesh->first_link, mesh->cells + 1));
  return expect_window(d, HM_WINDOW_LINK, mesh->link_to, links);
}

int hm_driver_open(hm_driver* d, const hm_bus* bus, const hm_mesh* mesh, uint32_t* buffer,
                   uint32_t buffer_words) {
  *d = (hm_driver){.bus = bus, .buffer = buffer, .buffer_words = buffer_words};
  if (buffer_words < 1) return HM_ERROR_SPACE;
  TRY(expect(d, HM_REG_ID, HM_ID_VALUE, HM_ERROR_ID));
  TRY(expect(d, HM_REG_VERSION, HM_VERSION_VALUE, HM_ERROR_ID));
  TRY(expect_mesh(d, mesh));
  TRY(read_register(d, HM_REG_CAP_NORMALISER, &d->normaliser));
  TRY(read_register(d, HM_REG_CAP_OUTPUT, &d->output));
  TRY(read_format(d, HM_REG_CAP_FORMAT_WEIGHT, &d->weight));
  TRY(read_format(d, HM_REG_CAP_FORMAT_BIAS, &d->bias));
  TRY(read_format(d, HM_REG_CAP_FORMAT_STATE, &d->state));
  return write_register(d, HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
}

/* ---- loading a network ---- */

/* Words on their way into a window, sent whenever the buffer is full. */
typedef struct stream {
  hm_driver* driver;
  uint32_t address, waiting;
  const hm_format* format;
  double scale; /* values times this count in the format's last places */
} stream;

static stream open_stream(hm_driver* d, uint32_t address, const hm_format* format, int shift) {
  return (stream){d, address, 0, format, hm_power_of_two(shift + hm_fraction_bits(format))};
}

static int flush(stream* s) {
  const hm_bus* bus = s->driver->bus;
  if (s->waiting == 0) return HM_OK;
  TRY(bus->write_burst(bus->context, s->address, s->driver->buffer, s->waiting));
  s->address += 4 * s->waiting;
  s->waiting = 0;
  return HM_OK;
}

static uint32_t count_vanished(const double* values, const uint32_t* words, uint32_t count) {
  uint32_t vanished = 0;
  for (uint32_t k = 0; k < count; ++k) vanished += (uint32_t)((values[k] != 0) & (words[k] == 0));
  return vanished;
}

/* As many values as there are, in bursts of a full buffer. */
static int put(stream* s, const double* values, uint32_t count) {
  hm_driver* d = s->driver;
  while (count > 0) {
    const uint32_t room = d->buffer_words - s->waiting, part = count < room ? count : room;
    d->clipped += hm_codes(values, part, s->scale, s->format, d->buffer + s->waiting);
    d->vanished += count_vanished(values, d->buffer + s->waiting, part);
    s->waiting += part;
    values += part;
    count -= part;
    if (s->waiting == d->buffer_words) TRY(flush(s));
  }
  return HM_OK;
}

/* A row, each value divided by `norm` before it is scaled. */
static int put_row(stream* s, const double* values, uint32_t count, double norm) {
  double divided[64];
  while (count > 0) {
    const uint32_t part = count < 64 ? count : 64;
    for (uint32_t k = 0; k < part; ++k) divided[k] = values[k] / norm;
    TRY(put(s, divided, part));
    values += part;
    count -= part;
  }
  return HM_OK;
}

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

/* Rows lie one behind the other, as the window has them. */
static int load_weights(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  stream weights = open_stream(d, HM_WINDOW_WEIGHT, &d->weight, shift);
  TRY(put(&weights, network->weight, hm_weight_count(mesh)));
  return flush(&weights);
}

static int load_biases(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  stream biases = open_stream(d, HM_WINDOW_BIAS, &d->bias, shift);
  TRY(put(&biases, network->bias, hm_neuron_count(mesh)));
  return flush(&biases);
}

static int load_prescaled_weights(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  stream weights = open_stream(d, HM_WINDOW_WEIGHT, &d->weight, 0);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      TRY(put_row(&weights, network->weight + hm_row_offset(mesh, c, p), hm_row_length(mesh, c),
                  row_norm(mesh, network, c, p)));
  return flush(&weights);
}

static int load_prescaled_biases(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  stream biases = open_stream(d, HM_WINDOW_BIAS, &d->bias, 0);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      TRY(put_row(&biases, network->bias + c * mesh->components + p, 1, row_norm(mesh, network, c, p)));
  return flush(&biases);
}

/* Only the sign of a binary neuron's s counts: no row is divided, and W stays symmetric. */
static int prescales(const hm_driver* d) {
  return d->output == HM_OUTPUT_MODIFIED && d->normaliser == HM_NORMALISER_PRESCALED;
}

static int load_rows(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  if (prescales(d)) {
    TRY(load_prescaled_weights(d, mesh, network));
    return load_prescaled_biases(d, mesh, network);
  }
  TRY(load_weights(d, mesh, network, shift));
  return load_biases(d, mesh, network, shift);
}

static int load_outputs(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  const uint32_t clipped = d->clipped, vanished = d->vanished; /* outputs are no part of either */
  stream outputs = open_stream(d, HM_WINDOW_OUTPUT, &d->state, 0);
  TRY(put(&outputs, network->output, hm_neuron_count(mesh)));
  d->clipped = clipped;
  d->vanished = vanished;
  return flush(&outputs);
}

/* ---- one relaxation ---- */

static int start_and_wait(const hm_driver* d, double threshold, uint32_t max_sweeps) {
  TRY(write_register(d, HM_REG_THRESHOLD, whole_places(threshold, &d->state)));
  TRY(write_register(d, HM_REG_MAX_SWEEPS, max_sweeps));
  TRY(write_register(d, HM_REG_IRQ_STATUS, HM_IRQ_DONE)); /* left over from a run that nobody waited for */
  TRY(write_register(d, HM_REG_CONTROL, HM_CONTROL_START));
  TRY(d->bus->wait(d->bus->context));
  return write_register(d, HM_REG_IRQ_STATUS, HM_IRQ_DONE);
}

static int read_counters(const hm_driver* d, hm_relaxation* result) {
  uint32_t status, low, high;
  TRY(read_register(d, HM_REG_STATUS, &status));
  if (!(status & HM_STATUS_DONE)) return HM_ERROR_BUSY;
  TRY(read_register(d, HM_REG_SWEEPS, &result->sweeps));
  TRY(read_register(d, HM_REG_CYCLES_LO, &low));
  TRY(read_register(d, HM_REG_CYCLES_HI, &high));
  result->converged = (status & HM_STATUS_CONVERGED) != 0;
  result->cycles = (uint64_t)high << 32 | low;
  return HM_OK;
}

static int read_outputs(const hm_driver* d, const hm_mesh* mesh, hm_network* network) {
  const uint32_t count = hm_neuron_count(mesh);
  const double last_place = 1 / hm_power_of_two(hm_fraction_bits(&d->state));
  for (uint32_t done = 0; done < count;) {
    const uint32_t part = count - done < d->buffer_words ? count - done : d->buffer_words;
    TRY(d->bus->read_burst(d->bus->context, HM_WINDOW_OUTPUT + 4 * done, d->buffer, part));
    for (uint32_t k = 0; k < part; ++k) network->output[done + k] = (int32_t)d->buffer[k] * last_place;
    done += part;
  }
  return HM_OK;
}

int hm_driver_relax(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                    uint32_t max_sweeps, hm_relaxation* result) {
  hm_driver* d = driver;
  const uint32_t neurons = hm_neuron_count(mesh);
  const uint64_t weight = largest_bits(network->weight, hm_weight_count(mesh));
  const uint64_t bias = largest_bits(network->bias, neurons);
  if (!is_finite(weight) || !is_finite(bias) || !is_finite(largest_bits(network->output, neurons)))
    return HM_ERROR_NUMBER;
  d->shift = prescales(d) ? 0 : block_exponent(d, value_of(weight), value_of(bias));
  d->clipped = d->vanished = 0;
  uint32_t status;
  TRY(read_register(d, HM_REG_STATUS, &status));
  if (status & HM_STATUS_BUSY) return HM_ERROR_BUSY;
  TRY(load_rows(d, mesh, network, d->shift));
  TRY(load_outputs(d, mesh, network));
  TRY(start_and_wait(d, threshold, max_sweeps));
  TRY(read_counters(d, result));
  return read_outputs(d, mesh, network);
}
