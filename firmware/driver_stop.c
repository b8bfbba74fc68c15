/* When the array shall stop: by how far outputs move, which THRESHOLD alone says, or by the inputs of neurons
   that may still move. */
#include "firmware/doubles.h"
#include "firmware/driver_parts.h"

/* The largest n of STOP.SHARE. */
static const uint32_t most_places = 63;

/* The n of the largest 2^-n that is not above the share, from 1 on; 0: no share. */
static uint32_t places_of(double share) {
  uint32_t n = 1;
  if (!(share > 0)) return 0;
  while (n < most_places && hm_power_of_two(-(int)n) > share) ++n;
  return n;
}

/* Sum of |w| of a row, as loaded but for the shift. */
static double row_sum(const hm_driver* d, const hm_mesh* mesh, const hm_network* network, uint32_t cell,
                      uint32_t p) {
  const double* row = network->weight + hm_row_offset(mesh, cell, p);
  const double bias = hm_magnitude(network->bias[cell * mesh->components + p]);
  double sum = 0;
  for (uint32_t k = 0; k < hm_row_length(mesh, cell); ++k) sum += hm_magnitude(row[k]);
  return hm_driver_prescales(d) && sum > 0 ? sum / (sum + bias) : sum;
}

static double largest_row(const hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  double largest = 0;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const double sum = row_sum(d, mesh, network, c, p);
      if (sum > largest) largest = sum;
    }
  return largest * hm_power_of_two(d->shift);
}

/* What a last place of every link is worth in s: a network whose links go to and fro between two codes about
   its rest has sums of that size, and half of it is not always reached. */
static int worth_of_a_place(const hm_driver* d, const hm_mesh* mesh, const hm_network* network,
                            uint64_t* worth) {
  const double most = 4611686018427387904.0; /* 2^62: no sum is larger */
  hm_format link, sum;
  TRY(hm_read_format(d, HM_REG_CAP_FORMAT_LINK, &link));
  TRY(hm_read_format(d, HM_REG_CAP_FORMAT_ACCUMULATOR, &sum));
  const int places = hm_fraction_bits(&sum) - hm_fraction_bits(&link);
  const double counted = largest_row(d, mesh, network) * hm_power_of_two(places);
  *worth = (uint64_t)(counted < most ? counted : most);
  return HM_OK;
}

int hm_driver_write_stop(hm_driver* d, const hm_mesh* mesh, const hm_network* network) {
  const uint32_t wanted =
      !d->stop.by_sum ? 0 : 1u << HM_SHIFT_STOP_BY_SUM | places_of(d->stop.share) << HM_SHIFT_STOP_SHARE;
  if (d->stop.by_sum) {
    uint64_t worth;
    if (HM_FIELD(d->version, VERSION_MINOR) < 1) return HM_ERROR_VERSION;
    TRY(worth_of_a_place(d, mesh, network, &worth));
    TRY(hm_write_register(d, HM_REG_SUM_THRESHOLD_LO, (uint32_t)worth));
    TRY(hm_write_register(d, HM_REG_SUM_THRESHOLD_HI, (uint32_t)(worth >> 32)));
  }
  if (wanted == d->stop_written) return HM_OK;
  d->stop_written = wanted;
  return hm_write_register(d, HM_REG_STOP, wanted);
}
