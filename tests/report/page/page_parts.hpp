// Parses a page, independently of the code that writes it.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::test {

using PageJson = nlohmann::ordered_json;

inline std::string inflated(const std::string& bytes) {
  std::string result;
  z_stream stream{};
  EXPECT_EQ(inflateInit(&stream), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  int status = Z_OK;
  while (status == Z_OK) {
    char room[1 << 14];
    stream.next_out = reinterpret_cast<Bytef*>(room);
    stream.avail_out = sizeof room;
    status = inflate(&stream, Z_NO_FLUSH);
    result.append(room, sizeof room - stream.avail_out);
  }
  EXPECT_EQ(status, Z_STREAM_END);
  inflateEnd(&stream);
  return result;
}

inline std::string from_base64(std::string_view text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xFFU);
  }
  return bytes;
}

/// The content of an element, or empty if it does not exist.
inline std::string part_of(const std::string& page, const std::string& name) {
  const std::string head = "id=\"data-" + name + "\">";
  const std::size_t begin = page.find(head);
  if (begin == std::string::npos) return "";
  const std::size_t from = begin + head.size();
  return inflated(from_base64(std::string_view(page).substr(from, page.find('<', from) - from)));
}

inline PageJson json_part(const std::string& page, const std::string& name) {
  return PageJson::parse(part_of(page, name));
}

/// Channels of a page: the values of each frame, in one take or two.
struct PageChannels {
  std::vector<std::vector<double>> before, after;
};

class PageReader {
 public:
  explicit PageReader(std::string bytes) : bytes_(std::move(bytes)) {}
  int byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
  std::vector<std::int64_t> remainders(std::size_t count) {
    std::vector<std::int64_t> result;
    for (std::size_t i = 0; i < count; ++i) {
      std::int64_t word = 0;
      for (std::size_t plane = 0; plane < 4; ++plane) {
        word |= static_cast<std::int64_t>(
                    static_cast<unsigned char>(bytes_.at(at_ + plane * count + i)))
                << 8 * plane;
      }
      result.push_back(word % 2 == 0 ? word / 2 : -(word + 1) / 2);
    }
    at_ += 4 * count;
    return result;
  }
  bool is_done() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

inline std::vector<std::int64_t> read_samples(PageReader& first, PageReader* second,
                                              std::size_t frames, std::size_t stride) {
  std::vector<std::int64_t> samples(frames);
  const int kind = first.byte();
  const auto coarse = first.remainders((frames + stride - 1) / stride);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const std::int64_t last = i > 0 ? samples[(i - 1) * stride] : 0;
    const std::int64_t before_last = i > 1 ? samples[(i - 2) * stride] : i == 1 ? last : 0;
    const std::int64_t guess = kind == 0 ? 0 : kind == 1 ? last : 2 * last - before_last;
    samples[i * stride] = coarse[i] + guess;
  }
  if (second == nullptr) return samples;
  const int fine_kind = second->byte();
  const auto fine = second->remainders(frames - coarse.size());
  std::size_t next = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t part = f % stride;
    if (part == 0) continue;
    const std::int64_t left = samples[f - part];
    double guess = 0;
    if (fine_kind == 1) {
      const bool has_right = f - part + stride < frames;
      const std::int64_t right = has_right ? samples[f - part + stride] : left;
      guess = static_cast<double>(left) +
              std::floor(static_cast<double>(right - left) * static_cast<double>(part) /
                         static_cast<double>(stride));
    }
    samples[f] = fine[next++] + static_cast<std::int64_t>(guess);
  }
  return samples;
}

/// Reads the samples before and after cleaning.
inline std::pair<std::vector<std::int64_t>, std::vector<std::int64_t>> read_pair(
    PageReader& first, PageReader* second, std::size_t frames, std::size_t stride) {
  if (frames == 0) return {};
  const bool before_first = first.byte() == 1;
  if (second != nullptr) {
    EXPECT_EQ(second->byte() == 1, before_first);
  }
  const auto one = read_samples(first, second, frames, stride);
  auto other = read_samples(first, second, frames, stride);
  for (std::size_t f = 0; f < frames; ++f) other[f] += one[f];
  return before_first ? std::pair(one, other) : std::pair(other, one);
}

inline PageChannels channels_in(const std::string& page) {
  const PageJson take = json_part(page, "take");
  const auto frames = take["told"].get<std::size_t>(), stride = take["stride"].get<std::size_t>();
  PageReader first(part_of(page, "first")), second(stride > 1 ? part_of(page, "second") : "");
  PageChannels channels;
  for (const double quantum : take["quanta"].get<std::vector<double>>()) {
    PageReader* const rest = stride > 1 ? &second : nullptr;
    const auto values_of = [&](const std::vector<std::int64_t>& samples) {
      std::vector<double> values;
      for (const auto sample : samples) values.push_back(static_cast<double>(sample) * quantum);
      return values;
    };
    if (!take["two"].get<bool>()) {
      channels.before.push_back(values_of(read_samples(first, rest, frames, stride)));
      continue;
    }
    const auto [before, after] = read_pair(first, rest, frames, stride);
    channels.before.push_back(values_of(before));
    channels.after.push_back(values_of(after));
  }
  EXPECT_TRUE(first.is_done());
  EXPECT_TRUE(second.is_done());
  return channels;
}

}  // namespace kinemend::test
