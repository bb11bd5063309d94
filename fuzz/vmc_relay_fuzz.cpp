// Relays any datagrams at any times: the output has the same number, order and sizes; bytes that
// are not OSC pass unchanged, and waiting data is bounded. The first byte selects the bones; each
// datagram has a byte for the time before it and two for its size.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/sessions.hpp"
#include "kinemend/methods.hpp"
#include "laws.hpp"
#include "live/osc.hpp"

namespace {

using namespace kinemend;

constexpr std::size_t most_waiting_bytes = 8192;

void check_messages(std::string_view datagram) {
  std::vector<OscMessage> messages;
  if (!read_osc(datagram, messages)) check(messages.empty());
  for (const OscMessage& message : messages) {
    check(message.arguments <= message.end && message.end <= datagram.size());
    check(message.address.starts_with('/'));
  }
}

bool is_osc(std::string_view datagram) {
  std::vector<OscMessage> messages;
  return read_osc(datagram, messages);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const auto cleaner = make_cleaner("median");
  VmcOptions options;
  options.most_waiting_bytes = most_waiting_bytes;
  if ((data[0] & 1) != 0) options.bones = {"Head", "Tail"};
  options.strength = (data[0] & 2) != 0 ? 0.5 : 1;
  std::vector<std::string> in, out;
  VmcSession session(*cleaner, options,
                     [&](std::string_view datagram) { out.emplace_back(datagram); });
  double now_s = 0;
  constexpr std::size_t head = 3;
  for (std::size_t at = 1; at + head <= size;) {
    const std::size_t wanted = data[at + 1] * 256U + data[at + 2];
    const std::size_t count = std::min(wanted, size - at - head);
    now_s += 0.002 * data[at];
    in.push_back(text_of(data + at + head, count));
    check_messages(in.back());
    session.receive(in.back(), now_s);
    check(session.waiting_bytes() <= most_waiting_bytes + in.back().size());
    at += head + count;
  }
  session.settle();
  check(out.size() == in.size() && session.waiting_bytes() == 0);
  for (std::size_t i = 0; i < in.size(); ++i) {
    check(out[i].size() == in[i].size());
    check(is_osc(in[i]) ? is_osc(out[i]) : out[i] == in[i]);
  }
  return 0;
}
