// Splits names into words and interprets each by the names of its neighbours.
#include "body/body_names.hpp"
#include "kinemend/extend/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace kinemend::representation {

namespace {

// Words whose meaning depends on other words of the same side.
enum class Word : std::uint8_t {
  unknown,
  plain,     // its meaning is `bone`
  shoulder,  // clavicle or upper arm
  leg,       // shin or thigh
  hip,       // pelvis, thigh, or the joint between them
  foot,      // foot, or toe if there is an ankle
  hand,      // hand, or palm if there is a wrist
};

struct Spelling {
  std::string_view word;
  Bone bone;
  Word kind = Word::plain;
};

constexpr std::array spellings = std::to_array<Spelling>({
    {"hips", Bone::pelvis},
    {"pelvis", Bone::pelvis},
    {"root", Bone::pelvis},
    {"hip", Bone::pelvis, Word::hip},
    {"spine", Bone::spine},
    {"tospine", Bone::spine},
    {"lowerback", Bone::spine},
    {"upperback", Bone::spine},
    {"back", Bone::spine},
    {"thorax", Bone::spine},
    {"chest", Bone::spine},
    {"upperchest", Bone::spine},
    {"abdomen", Bone::spine},
    {"torso", Bone::spine},
    {"waist", Bone::spine},
    {"neck", Bone::neck},
    {"lowerneck", Bone::neck},
    {"upperneck", Bone::neck},
    {"head", Bone::head},
    {"clavicle", Bone::clavicle},
    {"collar", Bone::clavicle},
    {"collarbone", Bone::clavicle},
    {"shoulder", Bone::upper_arm, Word::shoulder},
    {"shoulderjoint", Bone::upper_arm, Word::shoulder},
    {"arm", Bone::upper_arm},
    {"uparm", Bone::upper_arm},
    {"upperarm", Bone::upper_arm},
    {"humerus", Bone::upper_arm},
    {"shldr", Bone::upper_arm},
    {"forearm", Bone::forearm},
    {"lowarm", Bone::forearm},
    {"lowerarm", Bone::forearm},
    {"elbow", Bone::forearm},
    {"radius", Bone::forearm},
    {"wrist", Bone::hand},
    {"hand", Bone::hand, Word::hand},
    {"palm", Bone::palm},
    {"fingerbase", Bone::palm},
    {"hipjoint", Bone::hip},
    {"buttock", Bone::hip},
    {"upleg", Bone::thigh},
    {"upperleg", Bone::thigh},
    {"thigh", Bone::thigh},
    {"femur", Bone::thigh},
    {"leg", Bone::shin, Word::leg},
    {"lowleg", Bone::shin},
    {"lowerleg", Bone::shin},
    {"shin", Bone::shin},
    {"calf", Bone::shin},
    {"tibia", Bone::shin},
    {"knee", Bone::shin},
    {"ankle", Bone::foot},
    {"foot", Bone::foot, Word::foot},
    {"toe", Bone::toe},
    {"toes", Bone::toe},
    {"toebase", Bone::toe},
    {"ball", Bone::toe},
});

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Splits a name: "LHipJoint" gives l, hip, joint; "Bip01 L Thigh" gives bip01, l, thigh.
std::vector<std::string> tokens_of(std::string_view name) {
  const std::size_t colon = name.find_last_of(":|");
  if (colon != name.npos && colon + 1 < name.size()) name.remove_prefix(colon + 1);
  std::vector<std::string> tokens;
  bool open = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_letter_or_digit(name[i])) {
      open = false;
      continue;
    }
    const bool after_upper = i > 0 && is_upper(name[i - 1]);
    const bool before_lower = i + 1 < name.size() && is_letter_or_digit(name[i + 1]) &&
                              !is_upper(name[i + 1]) && !is_digit(name[i + 1]);
    if (is_upper(name[i]) && (!after_upper || before_lower)) open = false;
    if (!open) tokens.emplace_back();
    open = true;
    tokens.back() += lower_case(name[i]);
  }
  return tokens;
}

std::string_view without_digits(std::string_view word) {
  while (!word.empty() && is_digit(word.back())) word.remove_suffix(1);
  return word;
}

// Whether tools put the word before every name of a skeleton.
bool is_prefix(std::string_view token) {
  static constexpr std::array<std::string_view, 7> prefixes{"mixamorig", "bip", "joint",    "jnt",
                                                            "bone",      "def", "character"};
  return std::find(prefixes.begin(), prefixes.end(), without_digits(token)) != prefixes.end();
}

void drop_prefixes(std::vector<std::string>& tokens) {
  // VRM uses J_Bip_L_Hand and J_Bip_C_Hips.
  if (tokens.size() > 3 && tokens[0] == "j" && tokens[1] == "bip")
    tokens.erase(tokens.begin(), tokens.begin() + (tokens[2] == "c" ? 3 : 2));
  while (tokens.size() > 1 && is_prefix(tokens.front())) tokens.erase(tokens.begin());
  if (tokens.size() == 1 && is_prefix(tokens.front())) tokens.front() = "root";
}

std::string joined(const std::vector<std::string>& tokens) {
  std::string word;
  for (const std::string& token : tokens) word += token;
  return word;
}

const Spelling* spelling_of(std::string_view word) {
  const auto find = [](std::string_view wanted) -> const Spelling* {
    const auto* const found =
        std::find_if(spellings.begin(), spellings.end(),
                     [&](const Spelling& spelling) { return spelling.word == wanted; });
    return found == spellings.end() ? nullptr : found;
  };
  return find(without_digits(word));
}

// Maps "handindex1", "finger1" and "index1" to one word.
std::string finger_word(std::string word) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> spelled{
      {{"handthumb", "thumb"},
       {"handindex", "index"},
       {"handmiddle", "middle"},
       {"handmid", "middle"},
       {"handring", "ring"},
       {"handpinky", "pinky"},
       {"mid", "middle"},
       {"pinkie", "pinky"},
       {"little", "pinky"},
       {"handlittle", "pinky"},
       {"finger", "fingers"},
       {"handfingers", "fingers"}}};
  const std::string_view base = without_digits(word);
  const std::string digits = word.substr(base.size());
  for (const auto& [from, to] : spelled) {
    if (base == from) return std::string(to) + digits;
  }
  if (word == "thumb") return "thumb1";
  return word;
}

bool starts_with_any(std::string_view word, std::string_view a, std::string_view b) {
  return word.starts_with(a) || word.starts_with(b);
}

bool is_known_word(std::string_view word) {
  static constexpr std::array<std::string_view, 8> prefixes{"thumb", "index",  "middle", "ring",
                                                            "pinky", "finger", "mid",    "eye"};
  return spelling_of(word) != nullptr ||
         std::any_of(prefixes.begin(), prefixes.end(), [&](auto prefix) {
           return starts_with_any(word, prefix, std::string("hand").append(prefix));
         });
}

Side side_of(std::string_view token) {
  if (token == "l" || token == "left" || token == "lft") return Side::left;
  if (token == "r" || token == "right" || token == "rgt") return Side::right;
  return Side::none;
}

// Removes the side: a token of its own, or a prefix of a word that is known without it.
Side take_side(std::vector<std::string>& tokens, std::string& word) {
  const auto token = std::find_if(tokens.begin(), tokens.end(),
                                  [](const auto& t) { return side_of(t) != Side::none; });
  if (token != tokens.end() && tokens.size() > 1) {
    const Side side = side_of(*token);
    tokens.erase(token);
    drop_prefixes(tokens);
    word = joined(tokens);
    return side;
  }
  word = joined(tokens);
  if (spelling_of(word) != nullptr) return Side::none;
  for (const std::string_view prefix : {"left", "right", "l", "r"}) {
    if (!word.starts_with(prefix) || !is_known_word(word.substr(prefix.size()))) continue;
    word.erase(0, prefix.size());
    return side_of(prefix);
  }
  return Side::none;
}

// The words found on one side, by which ambiguous words are resolved.
struct SideWords {
  bool upper_arm = false, clavicle = false, thigh = false, hip = false, shin = false, ankle = false,
       wrist = false, other_fingers = false;

  void note(std::string_view word, const Spelling* spelling) {
    if (word.starts_with("middle")) other_fingers = true;
    if (spelling == nullptr) return;
    hip = hip || spelling->kind == Word::hip;
    if (spelling->kind != Word::plain) return;
    upper_arm = upper_arm || spelling->bone == Bone::upper_arm;
    clavicle = clavicle || spelling->bone == Bone::clavicle;
    thigh = thigh || spelling->bone == Bone::thigh;
    shin = shin || spelling->bone == Bone::shin;
    ankle = ankle || spelling->bone == Bone::foot;
    wrist = wrist || spelling->bone == Bone::hand;
  }
};

Bone bone_in_context(const Spelling& spelling, Side side, const SideWords& others) {
  switch (spelling.kind) {
    case Word::shoulder:
      return others.upper_arm && !others.clavicle ? Bone::clavicle : Bone::upper_arm;
    case Word::leg:
      return others.shin && !others.thigh && !others.hip ? Bone::thigh : Bone::shin;
    case Word::hip:
      if (side == Side::none) return Bone::pelvis;
      return others.thigh ? Bone::hip : Bone::thigh;
    case Word::foot:
      return others.ankle ? Bone::toe : Bone::foot;
    case Word::hand:
      return others.wrist ? Bone::palm : Bone::hand;
    case Word::plain:
    case Word::unknown:
      break;
  }
  return spelling.bone;
}

}  // namespace

std::string plain_name(std::string_view name) {
  std::vector<std::string> tokens = tokens_of(name);
  drop_prefixes(tokens);
  return joined(tokens);
}

std::vector<BoneName> bone_names(const std::vector<std::string>& names) {
  std::vector<BoneName> result;
  std::array<SideWords, 3> sides;
  for (const std::string& name : names) {
    std::vector<std::string> tokens = tokens_of(name);
    drop_prefixes(tokens);
    BoneName bone;
    bone.side = take_side(tokens, bone.word);
    bone.word = finger_word(std::move(bone.word));
    sides[static_cast<std::size_t>(bone.side)].note(bone.word, spelling_of(bone.word));
    result.push_back(std::move(bone));
  }
  for (BoneName& bone : result) {
    const SideWords& others = sides[static_cast<std::size_t>(bone.side)];
    const Spelling* spelling = spelling_of(bone.word);
    if (spelling != nullptr) bone.bone = bone_in_context(*spelling, bone.side, others);
    // A hand with only one finger moves all of them by it.
    if (bone.word == "index1" && !others.other_fingers) bone.word = "fingers";
  }
  return result;
}

std::int32_t find_bone(const std::vector<BoneName>& bones, Bone bone, Side side) {
  for (std::size_t j = bones.size(); j-- > 0;) {
    if (bones[j].bone == bone && bones[j].side == side) return static_cast<std::int32_t>(j);
  }
  return -1;
}

}  // namespace kinemend::representation
