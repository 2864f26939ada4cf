// SPDX-License-Identifier: Apache-2.0
#include "pairing/phrase.hpp"

#include <array>

#include "pairing/certificates.hpp"

namespace telehug {
namespace {

constexpr std::size_t words_of_a_phrase = 8;

// One for each byte: short, plain, and hard to mishear for one another.
constexpr std::array<const char*, 256> words = {
    "acorn",   "apple",    "arrow",   "autumn",   "bacon",   "badge",    "baker",   "balloon",  "banana",  "barn",
    "basket",  "beach",    "bear",    "beetle",   "bell",    "berry",    "bicycle", "bird",     "biscuit", "blanket",
    "boat",    "bonnet",   "book",    "bottle",   "bread",   "bridge",   "brook",   "broom",    "bucket",  "bus",
    "butter",  "button",   "cabin",   "cactus",   "cake",    "camel",    "candle",  "canoe",    "carpet",  "carrot",
    "castle",  "cat",      "cave",    "cellar",   "chair",   "cheese",   "cherry",  "chestnut", "chimney", "church",
    "circle",  "circus",   "clock",   "cloud",    "clover",  "coat",     "coconut", "coffee",   "comet",   "cookie",
    "copper",  "corn",     "cotton",  "cradle",   "crayon",  "cricket",  "crown",   "cup",      "curtain", "cushion",
    "daisy",   "desert",   "diamond", "dolphin",  "donkey",  "door",     "dragon",  "drawer",   "dream",   "drum",
    "duck",    "eagle",    "earth",   "easel",    "elbow",   "elephant", "engine",  "evening",  "falcon",  "farm",
    "feather", "fence",    "fern",    "fiddle",   "finger",  "fire",     "flag",    "flower",   "flute",   "forest",
    "fork",    "fountain", "fox",     "frog",     "garden",  "garlic",   "gate",    "ghost",    "giraffe", "glass",
    "globe",   "glove",    "goat",    "goose",    "grape",   "grass",    "guitar",  "hammer",   "harbour", "harp",
    "hat",     "hazel",    "hedge",   "hen",      "hill",    "honey",    "horse",   "house",    "island",  "ivory",
    "jacket",  "jelly",    "juice",   "jungle",   "kettle",  "king",     "kitchen", "kite",     "kitten",  "ladder",
    "lake",    "lamp",     "lantern", "leaf",     "lemon",   "letter",   "lion",    "lizard",   "lobster", "locket",
    "magnet",  "mango",    "maple",   "marble",   "market",  "meadow",   "melon",   "milk",     "mirror",  "mitten",
    "monkey",  "moon",     "morning", "mountain", "mouse",   "mushroom", "needle",  "nest",     "night",   "nut",
    "oak",     "ocean",    "olive",   "onion",    "orange",  "orchard",  "otter",   "oven",     "owl",     "paddle",
    "palace",  "panda",    "paper",   "parrot",   "peach",   "pear",     "pebble",  "pencil",   "pepper",  "piano",
    "picnic",  "pigeon",   "pillow",  "pine",     "pirate",  "planet",   "plum",    "pocket",   "pond",    "pony",
    "potato",  "prince",   "pumpkin", "puppet",   "puzzle",  "rabbit",   "radio",   "rain",     "raven",   "ribbon",
    "rice",    "ring",     "river",   "robin",    "rocket",  "roof",     "rose",    "saddle",   "sailor",  "salad",
    "sand",    "scarf",    "school",  "seal",     "shadow",  "sheep",    "shell",   "ship",     "shovel",  "silver",
    "slipper", "snail",    "snow",    "spider",   "spoon",   "star",     "stone",   "story",    "summer",  "swan",
    "table",   "tailor",   "teapot",  "thimble",  "thunder", "tiger",    "tomato",  "tower",    "train",   "tulip",
    "turtle",  "valley",   "violin",  "wagon",    "walnut",  "whale",
};

}  // namespace

std::string phrase_of(const std::string& agreed) {
  std::string phrase;
  for (const char byte : sha256(agreed).substr(0, words_of_a_phrase)) {
    if (!phrase.empty()) phrase += ' ';
    phrase += words[static_cast<unsigned char>(byte)];
  }
  return phrase;
}

}  // namespace telehug
