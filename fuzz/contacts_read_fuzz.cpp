// Reads any bytes as a file of contacts: sorted contacts of the take that are written back as equal
// contacts and can be held, or a one-line error that names the file.
#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/feet.hpp"
#include "laws.hpp"
#include "small_takes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinemend;
  static const Take clip = small_clip();
  static const std::size_t legs = find_legs(clip.skeleton).size();
  std::vector<FootContact> contacts;
  try {
    contacts = parse_contacts(text_of(data, size), "fuzz", clip);
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input});
    return 0;
  }
  for (const FootContact& contact : contacts) {
    check(contact.leg < legs && contact.first_frame <= contact.last_frame &&
          contact.last_frame < clip.frame_count());
  }
  check(parse_contacts(contacts_text(clip, contacts), "again", clip) == contacts);
  Take held = clip;
  FeetSettings settings;
  settings.contacts = contacts;
  clean_feet(held, settings);
  held.validate();
  return 0;
}
