/* From doubles to raw codes and back, over the bus. Registers and windows: docs/registers.md. */
#include "firmware/driver.h"

#include "firmware/registers.h"

#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const int error_ = (call);                                                                               \
    if (error_ != HM_OK) return error_;                                                                      \
  } while (0)

static double magnitude(double x) {
  return x < 0 ? -x : x;
}

static int is_finite(double x) {
  return x - x == 0;
}

static int32_t whole_units(double threshold, int fraction) {
  const double units = threshold * hm_power_of_two(fraction);
  return units >= 2147483647.0 ? INT32_MAX : (int32_t)units;
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

static int put(stream* s, double value) {
  int clipped = 0;
  s->driver->buffer[s->waiting++] = (uint32_t)hm_code(value * s->scale, s->format, &clipped);
  s->driver->clipped += (uint32_t)clipped;
  return s->waiting == s->driver->buffer_words ? flush(s) : HM_OK;
}

static int all_finite(const double* values, uint32_t count) {
  for (uint32_t k = 0; k < count; ++k)
    if (!is_finite(values[k])) return 0;
  return 1;
}

static double largest_of(const double* values, uint32_t count) {
  double largest = 0;
  for (uint32_t k = 0; k < count; ++k)
    if (magnitude(values[k]) > largest) largest = magnitude(values[k]);
  return largest;
}

/* One power of two for the whole network: W stays symmetric, and u = s / N does not see it. */
static int block_exponent(const hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  const double w = largest_of(network->weight, hm_weight_count(mesh));
  const double b = largest_of(network->bias, mesh->cells * mesh->components);
  if (w == 0 && b == 0) return 0;
  if (w == 0) return hm_room(b, &d->bias);
  if (b == 0) return hm_room(w, &d->weight);
  const int for_weights = hm_room(w, &d->weight), for_biases = hm_room(b, &d->bias);
  return for_weights < for_biases ? for_weights : for_biases;
}

/* What a prescaled row is divided by: N = sum |w| + |I|, or 1 for an empty row. */
static double row_norm(const hm_mesh* mesh, const hm_network* network, uint32_t cell, uint32_t p) {
  const double* row = network->weight + hm_row_offset(mesh, cell, p);
  double norm = magnitude(network->bias[cell * mesh->components + p]);
  for (uint32_t k = 0; k < hm_row_length(mesh, cell); ++k) norm += magnitude(row[k]);
  return norm > 0 ? norm : 1;
}

static int load_rows(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  stream weights = open_stream(d, HM_WINDOW_WEIGHT, &d->weight, shift);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const double* row = network->weight + hm_row_offset(mesh, c, p);
      const double norm = d->normaliser == HM_NORMALISER_PRESCALED ? row_norm(mesh, network, c, p) : 1;
      for (uint32_t k = 0; k < hm_row_length(mesh, c); ++k) TRY(put(&weights, row[k] / norm));
    }
  return flush(&weights);
}

static int load_biases(hm_driver* d, const hm_mesh* mesh, const hm_network* network, int shift) {
  stream biases = open_stream(d, HM_WINDOW_BIAS, &d->bias, shift);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const double norm = d->normaliser == HM_NORMALISER_PRESCALED ? row_norm(mesh, network, c, p) : 1;
      TRY(put(&biases, network->bias[c * mesh->components + p] / norm));
    }
  return flush(&biases);
}

static int load_outputs(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  const uint32_t clipped = d->clipped; /* an output is never scaled: it cannot clip what the network says */
  stream outputs = open_stream(d, HM_WINDOW_OUTPUT, &d->state, 0);
  for (uint32_t k = 0; k < mesh->cells * mesh->components; ++k) TRY(put(&outputs, network->output[k]));
  d->clipped = clipped;
  return flush(&outputs);
}

/* ---- one relaxation ---- */

static int start_and_wait(const hm_driver* d, double threshold, uint32_t max_sweeps) {
  TRY(write_register(d, HM_REG_THRESHOLD, (uint32_t)whole_units(threshold, hm_fraction_bits(&d->state))));
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
  const uint32_t count = mesh->cells * mesh->components;
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
  const uint32_t neurons = mesh->cells * mesh->components;
  if (!all_finite(network->weight, hm_weight_count(mesh)) || !all_finite(network->bias, neurons) ||
      !all_finite(network->output, neurons))
    return HM_ERROR_NUMBER;
  const int shift = d->normaliser == HM_NORMALISER_PRESCALED ? 0 : block_exponent(d, mesh, network);
  d->clipped = 0;
  uint32_t status;
  TRY(read_register(d, HM_REG_STATUS, &status));
  if (status & HM_STATUS_BUSY) return HM_ERROR_BUSY;
  TRY(load_rows(d, mesh, network, shift));
  TRY(load_biases(d, mesh, network, shift));
  TRY(load_outputs(d, mesh, network));
  TRY(start_and_wait(d, threshold, max_sweeps));
  TRY(read_counters(d, result));
  return read_outputs(d, mesh, network);
}
