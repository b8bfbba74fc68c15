/* Streams of codes into the array's windows, and codes back. Windows: docs/hardware/registers.md. */
#include "firmware/window.h"

#include "firmware/doubles.h"
#include "firmware/quantise_whole.h"
#include "firmware/try.h"

hm_stream hm_stream_open(const hm_line* line, const hm_window* window, const hm_format* format, int shift) {
  return (hm_stream){.line = line,
                     .format = format,
                     .scale = hm_power_of_two(shift + hm_fraction_bits(format)),
                     .address = window->offset,
                     .codes_a_word = window->codes_a_word};
}

hm_stream hm_stream_of_codes(const hm_line* line, const hm_window* window) {
  return (hm_stream){.line = line, .address = window->offset, .codes_a_word = window->codes_a_word};
}

static int flush(hm_stream* s) {
  const hm_bus* bus = s->line->bus;
  if (s->waiting == 0) return HM_OK;
  TRY(bus->write_burst(bus->context, s->address, s->line->buffer, s->waiting));
  s->address += 4 * s->waiting;
  s->waiting = 0;
  return HM_OK;
}

/* Packs codes where they lie, behind those that wait in the partial word. Returns how many words are full. */
static uint32_t pack(hm_stream* s, uint32_t* codes, uint32_t count) {
  if (s->codes_a_word == 1) return count;
  const uint32_t bits = 32 / s->codes_a_word, mask = (1u << bits) - 1;
  uint32_t full = 0;
  for (uint32_t k = 0; k < count; ++k) {
    s->partial |= (codes[k] & mask) << bits * s->held;
    if (++s->held < s->codes_a_word) continue;
    codes[full++] = s->partial;
    s->partial = s->held = 0;
  }
  return full;
}

static uint32_t count_vanished(const double* values, const uint32_t* codes, uint32_t count) {
  uint32_t vanished = 0;
  if (HM_DOUBLES_ARE_SOFT) return hm_vanished_by_bits(values, codes, count);
  for (uint32_t k = 0; k < count; ++k) vanished += (uint32_t)((values[k] != 0) & (codes[k] == 0));
  return vanished;
}

uint32_t* hm_stream_room(const hm_stream* s, uint32_t* count) {
  *count = s->line->buffer_words - s->waiting;
  return s->line->buffer + s->waiting;
}

int hm_stream_take(hm_stream* s, uint32_t count) {
  s->waiting += pack(s, s->line->buffer + s->waiting, count);
  return s->waiting == s->line->buffer_words ? flush(s) : HM_OK;
}

int hm_stream_put(hm_stream* s, const double* values, uint32_t count) {
  while (count > 0) {
    uint32_t room;
    uint32_t* const at = hm_stream_room(s, &room);
    const uint32_t part = count < room ? count : room;
    s->clipped += hm_codes(values, part, s->scale, s->format, at);
    s->vanished += count_vanished(values, at, part);
    TRY(hm_stream_take(s, part));
    values += part;
    count -= part;
  }
  return HM_OK;
}

int hm_stream_put_row(hm_stream* s, const double* values, uint32_t count, double norm) {
  double divided[64];
  while (count > 0) {
    const uint32_t part = count < 64 ? count : 64;
    for (uint32_t k = 0; k < part; ++k) divided[k] = values[k] / norm;
    TRY(hm_stream_put(s, divided, part));
    values += part;
    count -= part;
  }
  return HM_OK;
}

int hm_stream_end(hm_stream* s) {
  if (s->held > 0) s->line->buffer[s->waiting++] = s->partial;
  s->partial = s->held = 0;
  return flush(s);
}

/* Codes of a burst, sign extended. */
static void unpack(const uint32_t* words, uint32_t codes_a_word, double last_place, double* values,
                   uint32_t count) {
  if (codes_a_word == 1) {
    for (uint32_t k = 0; k < count; ++k) values[k] = (int32_t)words[k] * last_place;
    return;
  }
  const uint32_t bits = 32 / codes_a_word, sign = 1u << (bits - 1);
  for (uint32_t k = 0; k < count; ++k) {
    const uint32_t low = words[k / codes_a_word] >> bits * (k % codes_a_word) & (2 * sign - 1);
    values[k] = ((int32_t)(low ^ sign) - (int32_t)sign) * last_place;
  }
}

int hm_window_read_codes(const hm_line* line, const hm_window* window, int32_t* codes, uint32_t count) {
  const uint32_t n = window->codes_a_word, down = 32 - 32 / n, words = count / n + (count % n != 0);
  for (uint32_t done = 0; done < words;) {
    const uint32_t part = words - done < line->buffer_words ? words - done : line->buffer_words;
    TRY(line->bus->read_burst(line->bus->context, window->offset + 4 * done, line->buffer, part));
    const uint32_t first = n * done, some = count - first < n * part ? count - first : n * part;
    for (uint32_t k = 0; k < some; ++k)
      codes[first + k] = (int32_t)(line->buffer[k / n] << (down - 32 / n * (k % n))) >> down;
    done += part;
  }
  return HM_OK;
}

int hm_window_read(const hm_line* line, const hm_window* window, double last_place, double* values,
                   uint32_t count) {
  const uint32_t n = window->codes_a_word, words = count / n + (count % n != 0);
  for (uint32_t done = 0; done < words;) {
    const uint32_t part = words - done < line->buffer_words ? words - done : line->buffer_words;
    TRY(line->bus->read_burst(line->bus->context, window->offset + 4 * done, line->buffer, part));
    const uint32_t first = n * done, codes = count - first < n * part ? count - first : n * part;
    unpack(line->buffer, n, last_place, values + first, codes);
    done += part;
  }
  return HM_OK;
}
