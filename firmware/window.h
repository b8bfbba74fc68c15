/* The array's windows as doubles: values on their way into one become codes, packed as the array has them,
   and come back from one. */
#ifndef HOPMESH_FIRMWARE_WINDOW_H
#define HOPMESH_FIRMWARE_WINDOW_H

#include "firmware/bus.h"
#include "firmware/quantise.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a window begins, and how many codes share a word: 1, 2 or 4. */
typedef struct hm_window {
  uint32_t offset, codes_a_word;
} hm_window;

/* The bus, and the caller's room for a burst of 1 word or more. */
typedef struct hm_line {
  const hm_bus* bus;
  uint32_t* buffer;
  uint32_t buffer_words;
} hm_line;

/* Codes on their way into a window, sent whenever the buffer is full. */
typedef struct hm_stream {
  const hm_line* line;
  const hm_format* format;
  double scale;                         /* values times this count in the format's last places */
  uint32_t address, waiting;            /* of the burst to come: where it goes, and its words so far */
  uint32_t codes_a_word, held, partial; /* held: codes in the word at hand, which is not full yet */
  uint32_t clipped;                     /* values that did not fit the format */
  uint32_t vanished;                    /* values that were not 0 and became code 0 */
} hm_stream;

/* Values are multiplied by 2^shift before they become codes. */
hm_stream hm_stream_open(const hm_line* line, const hm_window* window, const hm_format* format, int shift);
/* Of codes that are made already: by hm_stream_room and hm_stream_take alone. */
hm_stream hm_stream_of_codes(const hm_line* line, const hm_window* window);
/* Where the next codes go, and how many of them at most. */
uint32_t* hm_stream_room(const hm_stream* stream, uint32_t* count);
/* Takes so many that were written there. HM_OK, or an error of the bus. */
int hm_stream_take(hm_stream* stream, uint32_t count);
/* As many values as there are, in bursts of a full buffer. HM_OK, or an error of the bus. */
int hm_stream_put(hm_stream* stream, const double* values, uint32_t count);
/* As hm_stream_put, each value divided by `norm` before it is scaled. */
int hm_stream_put_row(hm_stream* stream, const double* values, uint32_t count, double norm);
/* Sends the words that still wait in the buffer. */
int hm_stream_end(hm_stream* stream);

/* The first `count` codes of a window. HM_OK, or an error of the bus. */
int hm_window_read_codes(const hm_line* line, const hm_window* window, int32_t* codes, uint32_t count);
/* The first `count` codes of a window, times `last_place`. HM_OK, or an error of the bus. */
int hm_window_read(const hm_line* line, const hm_window* window, double last_place, double* values,
                   uint32_t count);

#ifdef __cplusplus
}
#endif

#endif
