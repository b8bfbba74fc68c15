/* The table of m of a momentum array. */
#include "firmware/doubles.h"
#include "firmware/driver_parts.h"

static const hm_format format_of_m = {16, 1, HM_RND, HM_SAT};

/* Places of the table's window, those behind its last entry too, which nobody looks at. */
static int count_entries(const hm_driver* d, uint32_t* entries) {
  uint32_t words;
  TRY(hm_read_register(d, HM_REG_CAP_MOMENTUM_WORDS, &words));
  *entries = words * d->momentum.codes_a_word;
  return HM_OK;
}

/* m_k = (t_k - 1) / t_(k+1) with t_0 = 1 and t_(k+1) = (1 + sqrt(1 + 4 t_k^2)) / 2. */
static int put_sequence(const hm_driver* d, uint32_t entries) {
  hm_stream table = hm_stream_open(&d->line, &d->momentum, &format_of_m, 0);
  double t = 1;
  for (uint32_t k = 0; k < entries; ++k) {
    const double next = (1 + sqrt(1 + 4 * t * t)) / 2, m = (t - 1) / next;
    TRY(hm_stream_put(&table, &m, 1));
    t = next;
  }
  return hm_stream_end(&table);
}

int hm_driver_put_momentum(hm_driver* d, const double* m, uint32_t count) {
  uint32_t entries;
  TRY(count_entries(d, &entries));
  if (count < 1 || count > entries) return HM_ERROR_SPACE;
  hm_stream table = hm_stream_open(&d->line, &d->momentum, &format_of_m, 0);
  TRY(hm_stream_put(&table, m, count));
  for (uint32_t k = count; k < entries; ++k) TRY(hm_stream_put(&table, m + count - 1, 1));
  return hm_stream_end(&table);
}

int hm_driver_open_momentum(hm_driver* d) {
  uint32_t packing, entries;
  TRY(hm_read_register(d, HM_REG_CAP_PACKING, &packing));
  d->momentum.codes_a_word = HM_FIELD(packing, CAP_PACKING_MOMENTUM);
  TRY(hm_read_register(d, HM_REG_CAP_WINDOW_MOMENTUM, &d->momentum.offset));
  TRY(count_entries(d, &entries));
  return put_sequence(d, entries);
}
