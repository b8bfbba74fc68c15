// The array in somebody else's platform: a host that writes a network of two cells into it over TLM-2.0,
// starts it, sleeps until the interrupt, and reads the outputs back. What each register means:
// docs/hardware/registers.md. A real host runs the driver in firmware/ instead of doing this by hand; here
// every transfer is meant to be seen.
#include "firmware/registers.h"
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "rtl_model/systemc/device.h"

#include <cmath>
#include <cstdio>
#include <tlm_utils/simple_initiator_socket.h>

using namespace hopmesh;

class Host : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Host);
  explicit Host(sc_core::sc_module_name name) : sc_module(name), socket("socket"), irq("irq") {
    SC_THREAD(program);
  }

  tlm_utils::simple_initiator_socket<Host> socket;
  sc_core::sc_in<bool> irq;

 private:
  void program() {
    look();
    load();
    run();
    print_outputs();
  }

  // An array tells what it is, so that one program can drive any of them.
  void look() {
    if (read(HM_REG_ID) != HM_ID_VALUE) SC_REPORT_FATAL("host", "no Hopmesh array at this address");
    if (HM_FIELD(read(HM_REG_VERSION), VERSION_MAJOR) != HM_VERSION_MAJOR)
      SC_REPORT_FATAL("host", "registers of another version");
    std::printf("array of %u cells of %u neurons, %u weights\n", read(HM_REG_CAP_CELLS),
                read(HM_REG_CAP_NEURONS_PER_CELL), read(HM_REG_CAP_WEIGHT_WORDS));
  }

  // Energy can only fall, and it is least where every neuron's input s = sum(w V) + I is zero. Here the
  // x-neurons and the y-neurons form two separate pairs, each with
  //     -1.0 Va + 0.5 Vb + Ia = 0        x: I = (0.25, 0)  =>  V = (1/3, 1/6)
  //      0.5 Va - 1.0 Vb + Ib = 0        y: I = (0, -0.5)  =>  V = (-1/3, -2/3)
  void load() {
    const std::vector<double> weights = {
        // own x  own y  neighbour's x, y
        -1.0, 0.0,  0.5, 0.0, // cell a, x
        0.0,  -1.0, 0.0, 0.5, // cell a, y
        -1.0, 0.0,  0.5, 0.0, // cell b, x
        0.0,  -1.0, 0.0, 0.5, // cell b, y
    };
    write(read(HM_REG_CAP_WINDOW_WEIGHT), codes(weights, HM_REG_CAP_FORMAT_WEIGHT));
    write(read(HM_REG_CAP_WINDOW_BIAS), codes({0.25, 0.0, 0.0, -0.5}, HM_REG_CAP_FORMAT_BIAS));
    write(read(HM_REG_CAP_WINDOW_OUTPUT), std::vector<std::uint32_t>(4, 0)); // start from V = 0
  }

  void run() {
    write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
    write(HM_REG_THRESHOLD, 0); // until nothing moves any more, not even by the last place
    write(HM_REG_MAX_SWEEPS, 1000);
    write(HM_REG_CONTROL, HM_CONTROL_START);
    if (!irq.read()) wait(irq.posedge_event());
    write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
    std::printf("%s after %u sweeps, %u cycles, at %s\n",
                read(HM_REG_STATUS) & HM_STATUS_CONVERGED ? "at rest" : "still moving", read(HM_REG_SWEEPS),
                read(HM_REG_CYCLES_LO), sc_core::sc_time_stamp().to_string().c_str());
  }

  void print_outputs() {
    std::vector<std::uint32_t> outputs(4);
    transfer(tlm::TLM_READ_COMMAND, read(HM_REG_CAP_WINDOW_OUTPUT), outputs);
    const double last_place = std::ldexp(1.0, -fraction_bits(HM_REG_CAP_FORMAT_STATE));
    for (int cell = 0; cell < 2; ++cell)
      std::printf("cell %c: V = (%.3f, %.3f)\n", 'a' + cell,
                  static_cast<std::int32_t>(outputs[2 * cell]) * last_place,
                  static_cast<std::int32_t>(outputs[2 * cell + 1]) * last_place);
  }

  // A format register holds width | integer bits << 8 | ...
  int fraction_bits(std::uint32_t format_register) {
    const std::uint32_t format = read(format_register);
    return static_cast<int>(format & 255) - static_cast<std::int8_t>(format >> 8);
  }

  // A code c stands for c * 2^-fraction. All values here have exact codes, so no rounding mode matters.
  std::vector<std::uint32_t> codes(const std::vector<double>& values, std::uint32_t format_register) {
    const int fraction = fraction_bits(format_register);
    std::vector<std::uint32_t> words;
    for (double value : values)
      words.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::ldexp(value, fraction))));
    return words;
  }

  std::uint32_t read(std::uint32_t address) {
    std::vector<std::uint32_t> word(1);
    transfer(tlm::TLM_READ_COMMAND, address, word);
    return word[0];
  }

  void write(std::uint32_t address, std::uint32_t word) { write(address, std::vector<std::uint32_t>{word}); }

  void write(std::uint32_t address, std::vector<std::uint32_t> words) {
    transfer(tlm::TLM_WRITE_COMMAND, address, words);
  }

  // The array is loosely timed: it adds to `delay` how long the bus was held. Waiting it out after every
  // transfer is the simplest host; one with a quantum keeper may go on and wait later.
  void transfer(tlm::tlm_command command, std::uint32_t address, std::vector<std::uint32_t>& words) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(words.data()));
    payload.set_data_length(static_cast<unsigned>(4 * words.size()));
    payload.set_streaming_width(static_cast<unsigned>(4 * words.size()));
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    socket->b_transport(payload, delay);
    if (payload.is_response_error()) SC_REPORT_FATAL("host", payload.get_response_string().c_str());
    wait(delay);
  }
};

int sc_main(int, char**) {
  // Two cells of two neurons, joined by one link: cell 0's only neighbour is 1, and cell 1's is 0.
  const spec::Topology topology{2, {0, 1, 2}, {1, 0}};
  const spec::ArraySpec array = spec::descent_array();
  if (const auto fault = spec::validate(array, topology.most_taps())) {
    std::fprintf(stderr, "%s = %s: expected %s\n", fault->key.c_str(), fault->found.c_str(),
                 fault->expected.c_str());
    return 2;
  }

  Host host("host");
  systemc::Device device("device", array, topology);
  sc_core::sc_signal<bool> irq("irq");
  host.socket.bind(device.socket);
  host.irq(irq);
  device.irq(irq);

  sc_core::sc_start(); // until nothing is left to happen: the array's clock stands still between runs
  return 0;
}
