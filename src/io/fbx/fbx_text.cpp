// Walks over the records of an FBX file in text.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/quote.hpp"
#include "io/fbx/fbx_tree.hpp"

namespace kinemend {

namespace {

bool is_fbx_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\0'; }

bool ends_fbx_word(char c) {
  return is_fbx_blank(c) || c == ',' || c == '{' || c == '}' || c == ':' || c == ';' || c == '"';
}

class TextFbxReader {
 public:
  TextFbxReader(FbxTree& tree, std::size_t max_depth)
      : tree_(tree), bytes_(tree.bytes), builder_(tree), max_depth_(max_depth) {}

  void read() {
    if (bytes_.substr(0, 3) == "\xEF\xBB\xBF") place_ = 3;
    read_version();
    while (skip_blanks()) {
      if (bytes_[place_] == '}') {
        end_block();
      } else {
        read_record();
      }
    }
    if (builder_.depth() > 0) {
      throw tree_.error_at(bytes_.size(), "the file ends within braces that are open");
    }
    if (tree_.records.empty()) throw tree_.error_at(0, "the file holds no records");
    tree_.records_end = bytes_.size();
  }

 private:
  // Reads the version from the first comment: `; FBX 7.4.0 project file`.
  void read_version() {
    const std::size_t found = bytes_.substr(0, 1024).find("FBX ");
    if (found == bytes_.npos) return;
    std::uint32_t parts[3] = {0, 0, 0};
    std::size_t part = 0;
    for (std::size_t i = found + 4; i < bytes_.size() && part < 3; ++i) {
      const char c = bytes_[i];
      if (c == '.') {
        ++part;
      } else if (c >= '0' && c <= '9' && parts[part] < 100) {
        parts[part] = 10 * parts[part] + static_cast<std::uint32_t>(c - '0');
      } else {
        break;
      }
    }
    tree_.version = 1000 * parts[0] + 100 * parts[1] + 10 * parts[2];
  }

  // Moves past blanks and comments; returns false at the end.
  bool skip_blanks() {
    while (place_ < bytes_.size()) {
      if (bytes_[place_] == ';') {
        place_ = std::min(bytes_.find('\n', place_), bytes_.size());
      } else if (is_fbx_blank(bytes_[place_])) {
        ++place_;
      } else {
        return true;
      }
    }
    return false;
  }

  std::size_t word_end(std::size_t from) const {
    while (from < bytes_.size() && !ends_fbx_word(bytes_[from])) ++from;
    return from;
  }

  Error unexpected(std::string_view wanted) const {
    return tree_.error_at(place_,
                          fmt::format("expected {}, found {}", wanted,
                                      quote(bytes_.substr(place_, word_end(place_ + 1) - place_))));
  }

  void end_block() {
    if (builder_.depth() == 0) throw tree_.error_at(place_, "a brace closes nothing");
    ++place_;
    builder_.top().end = place_;
    builder_.close();
  }

  void read_record() {
    const std::size_t end = word_end(place_);
    std::size_t colon = end;
    while (colon < bytes_.size() && (bytes_[colon] == ' ' || bytes_[colon] == '\t')) ++colon;
    if (end == place_ || colon >= bytes_.size() || bytes_[colon] != ':')
      throw unexpected("the name of a record");
    if (builder_.depth() >= max_depth_)
      throw tree_.error_at(place_, fmt::format("records are nested deeper than {}", max_depth_));
    FbxRecord record;
    record.begin = place_;
    record.name_size = static_cast<std::uint32_t>(end - place_);
    record.first_property = static_cast<std::uint32_t>(tree_.properties.size());
    const bool is_array = bytes_.substr(place_, end - place_) == "a" && holds_array();
    record.properties_begin = place_ = colon + 1;
    builder_.open(record);
    if (is_array) {
      read_numbers();
    } else {
      read_properties();
    }
  }

  // Whether the open record is an array, whose numbers follow `a:`.
  bool holds_array() {
    if (builder_.depth() == 0) return false;
    const FbxProperty* const count = tree_.property(builder_.top(), 0);
    return count != nullptr && count->type == '*';
  }

  void read_numbers() {
    const std::size_t end = std::min(bytes_.find('}', place_), bytes_.size());
    add('A', place_, end - place_);
    place_ = end;
    finish_properties(end);
    builder_.close();
  }

  void read_properties() {
    std::size_t last_end = place_;
    bool may_follow = true, after_comma = false;
    while (skip_blanks()) {
      const char c = bytes_[place_];
      if (c == ',') {
        ++place_;
        may_follow = after_comma = true;
      } else if (c == '{') {
        finish_properties(last_end);
        ++place_;
        return;
      } else if (c == '}' || !may_follow || (!after_comma && is_name(place_))) {
        break;
      } else {
        read_value();
        last_end = place_;
        may_follow = after_comma = false;
      }
    }
    finish_properties(last_end);
    builder_.top().end = last_end;
    builder_.close();
  }

  // Whether a word with a colon begins here, which is the next record.
  bool is_name(std::size_t place) const {
    const std::size_t end = word_end(place);
    return end > place && end < bytes_.size() && bytes_[end] == ':';
  }

  void read_value() {
    const char c = bytes_[place_];
    if (c == '"') {
      const std::size_t end = bytes_.find('"', place_ + 1);
      if (end == bytes_.npos) throw tree_.error_at(place_, "a string does not end");
      add('S', place_ + 1, end - place_ - 1);
      place_ = end + 1;
      return;
    }
    const std::size_t end = word_end(place_);
    if (end == place_) throw unexpected("a value");
    const bool is_number = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
    if (c == '*') {
      add('*', place_ + 1, end - place_ - 1);
    } else {
      add(is_number ? 'N' : 'W', place_, end - place_);
    }
    place_ = end;
  }

  void add(char type, std::size_t begin, std::size_t size) {
    if (size > std::numeric_limits<std::uint32_t>::max() ||
        tree_.properties.size() >= std::numeric_limits<std::uint32_t>::max()) {
      throw tree_.error_at(begin, "a value is too long");
    }
    tree_.properties.push_back({begin, static_cast<std::uint32_t>(size), type});
    ++builder_.top().property_count;
  }

  void finish_properties(std::size_t end) {
    builder_.top().properties_end = end;
    builder_.top().end = end;
  }

  FbxTree& tree_;
  std::string_view bytes_;
  FbxRecordBuilder builder_;
  std::size_t max_depth_;
  std::size_t place_ = 0;
};

}  // namespace

void read_text_fbx_records(FbxTree& tree, std::size_t max_depth) {
  TextFbxReader(tree, max_depth).read();
}

}  // namespace kinemend
