// SPDX-License-Identifier: MIT
#include "recipe_texts.h"

namespace sherd::cli {

const std::array<RecipeExample, 9> kRecipeExamples = {{
    {"drawn", "cracks that an artist drew, coarse and fine", R"({
  // Coarse to fine; each level divides the pieces of the one before.
  "levels": [
    {"map": "coarse.svg", "name": "chunks"},
    {"map": "fine.svg"}
  ],
  "interior": {
    "type": "medial",            // or "shell", "solid": docs/interiors.md
    "material": "clay inside"    // of the model; leave it out for a neutral grey
  },
  "physics": {"density": 1900, "strength": 1e6, "toughness": 30}   // kg/m3, Pa, J/m2
}
)"},
    {"wall", "drawn cracks straight through a wall, whose stones crumble where they are large", R"({
  "levels": [
    {"map": "cracks.svg", "name": "stones"},
    // Stones hold better than the mortar between them: Pa and J/m2, where this level parts.
    {"cut": "voronoi:6:1:larger=0.02", "name": "rubble", "strength": 4e6, "toughness": 120},
    {"cut": "voronoi:4:2:larger=0.01"}
  ],
  "interior": {
    "type": "solid",
    "roughness": {"amplitude": 0.01, "size": 0.08}   // metres
  },
  // It stands on a foundation: everything below 5 cm is held, in coordinates of the scene.
  "anchors": [{"below": 0.05, "strength": 8e6}],
  // "materials": {"plaster": {"density": 1100}},    // for pieces that this material covers most of
  "physics": {"density": 2300}                       // kg/m3, for all others
}
)"},
    {"statue", "a figure on a base that stays, modelled in centimetres", R"({
  "unitScale": 0.01,               // metres per unit of the model; all numbers below are in metres
  "levels": [
    {"map": "cracks.svg", "name": "limbs", "strength": 2e6},   // a label in it says name: base
    {"cut": "voronoi:5:1:larger=0.01", "name": "chips", "strength": 6e6}
  ],
  "interior": {"type": "medial", "material": "marble inside"},
  "materials": {
    "marble": {"density": 2700, "friction": 0.4, "toughness": 60},
    "bronze": {"density": 8700, "strength": 9e6, "toughness": 4000}
  },
  "anchors": [
    {"label": "base"},                                          // a piece by its name
    {"box": {"min": [-0.1, 0, -0.1], "max": [0.1, 0.2, 0.1]}}   // or whatever lies in a box
  ]
}
)"},
    {"boulder", "boulders first, and what is drawn on them, but only where they are large", R"({
  "levels": [
    {"cut": "voronoi:6", "name": "boulders"},
    {"map": "cracks.svg", "only": {"larger": 0.1}},          // lines in large boulders
    {"cut": "voronoi:4:1", "only": {"near": [[0, 1.7, 0]], "within": 0.2}}
  ],
  "interior": {"type": "solid"}    // with "medial" a crack would show inside the boulders
}
)"},
    {"stone", "any closed model in pieces, no drawing needed", R"({
  "levels": [
    {"cut": "voronoi:8:1", "name": "boulders"},      // 8 cells, seed 1
    {"cut": "voronoi:6:1", "name": "gravel"}         // each boulder in 6
  ],
  "interior": {"roughness": {"amplitude": 0.02, "size": 0.1}},
  "physics": {"density": 2600, "strength": 5e6}
}
)"},
    {"cliff", "rubble that comes off in chunks, large ones first", R"({
  // The finest pieces are cut, the coarser ones are groups of them.
  "levels": [
    {"cluster": "4", "name": "ledges"},              // of the boulders
    {"cluster": "12:evenness=0.7", "name": "boulders"},   // of the rubble; 1: all alike in volume
    {"cut": "voronoi:60:1", "name": "rubble"}
  ],
  "interior": {"roughness": {"amplitude": 0.02, "size": 0.1}},
  "physics": {"density": 2600, "strength": 3e6}
}
)"},
    {"glass", "a pane that was hit: sectors and rings, then splinters near the middle", R"({
  "levels": [
    {"cut": "glass:11x4:3"},                         // add :at=X,Y,Z where it was hit
    {"cut": "voronoi:3:1:smaller=0.03"}
  ],
  "interior": {"normals": "flat"},
  "physics": {"density": 2500, "strength": 3e7, "toughness": 8}
}
)"},
    {"bricks", "masonry in bond, each brick in three", R"({
  "levels": [
    {"cut": "bricks:6x8x1", "name": "bricks"},       // in a row, rows, deep
    {"cut": "voronoi:3:1:larger=0.005"}
  ],
  "physics": {"density": 1800}
}
)"},
    {"wood", "splinters along the grain", R"({
  "levels": [
    {"cut": "wood:6:1:axis=y:elongation=6"},
    {"cut": "wood:4:2:axis=y:elongation=16"}
  ],
  "physics": {"density": 700, "strength": 4e7, "toughness": 500}
}
)"},
}};

const char* const kRecipeSchema = R"({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "title": "Sherd recipe",
  "description": "How sherd-bake breaks a model. Comments are allowed; every key may be left out.",
  "type": "object",
  "additionalProperties": false,
  "properties": {
    "$schema": {"description": "where this schema is, for editors", "type": "string"},
    "levels": {
      "description": "Coarse to fine, each dividing the pieces of the one before: lines (map, pattern) and cuts in any order; a cluster groups the pieces of the level behind it.",
      "type": "array", "minItems": 1,
      "items": {
        "type": "object", "additionalProperties": false,
        "oneOf": [{"required": ["map"]}, {"required": ["pattern"]}, {"required": ["cut"]}, {"required": ["cluster"]}],
        "properties": {
          "map": {"description": "SVG, JSON, PNG or JPEG, relative to the recipe", "type": "string", "minLength": 1},
          "pattern": {"description": "lines by a pattern, like voronoi:12 or grid:4x3:brick", "type": "string", "pattern": "^(voronoi|grid|radial|wood):"},
          "cut": {
            "description": "through the volume",
            "anyOf": [
              {"description": "like voronoi:12, grid:30, slices:2x3x2, wood:8, points:X,Y,Z;X,Y,Z, bricks:6x8x1, glass:11x4 or map:cracks.svg:axis=z; larger=, smaller=, near=, within= and name= choose pieces", "type": "string", "pattern": "^(voronoi|grid|slices|wood|points|bricks|glass|map):"},
              {
                "description": "straight through along a drawing",
                "type": "object", "additionalProperties": false, "required": ["map"],
                "properties": {
                  "map": {"description": "SVG, JSON, PNG or JPEG, relative to the recipe", "type": "string", "minLength": 1},
                  "axis": {"description": "of the object, looked along; left out: onto its largest side", "enum": ["x", "y", "z", "-x", "-y", "-z"]},
                  "larger": {"description": "only pieces of at least this share of the object's volume", "type": "number", "minimum": 0, "maximum": 1},
                  "smaller": {"description": "at most this share", "type": "number", "minimum": 0, "maximum": 1},
                  "near": {
                    "description": "only pieces near this point, or one of these, metres in the scene",
                    "anyOf": [
                      {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e9, "maximum": 1e9}},
                      {"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e9, "maximum": 1e9}}}
                    ]
                  },
                  "within": {"description": "metres from there; 0: it is inside", "type": "number", "minimum": 0, "maximum": 1e9},
                  "name": {"description": "only pieces with this name, or part of one with it", "type": "string", "minLength": 1}
                }
              }
            ]
          },
          "cluster": {"description": "so many groups of the next finer level's pieces, in each piece of the level before: 8 or 12:evenness=0.8; larger=, smaller=, near=, within= and name= choose pieces", "type": "string", "pattern": "^[0-9]+(:.+)?$"},
          "projection": {"description": "how a drawing lies on the object", "type": "string", "pattern": "^(uv|box|planar(:.+)?|cylindrical(:.+)?)$"},
          "strength": {"description": "Pa, of bonds between pieces that part at this level; lines and labels of drawings win", "type": "number", "minimum": 0, "maximum": 1e15},
          "toughness": {"description": "J/m2, likewise", "type": "number", "minimum": 0, "maximum": 1e15},
          "only": {
            "description": "which pieces of the level before are divided; the others stand for themselves. All that is said must hold",
            "type": "object", "additionalProperties": false, "minProperties": 1,
            "properties": {
              "larger": {"description": "at least this share of the object's volume", "type": "number", "minimum": 0, "maximum": 1},
              "smaller": {"description": "at most", "type": "number", "minimum": 0, "maximum": 1},
              "near": {"description": "[X, Y, Z] in the scene's metres, or a list of such points", "type": "array", "minItems": 1},
              "within": {"description": "metres from one of the points; 0: it is inside", "type": "number", "minimum": 0, "maximum": 1e9},
              "name": {"description": "that a label gives", "type": "string"}
            }
          },
          "name": {"type": "string"}
        }
      }
    },
    "interior": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "type": {"enum": ["medial", "shell", "solid"]},
        "shell": {
          "type": "object", "additionalProperties": false,
          "properties": {
            "thickness": {"description": "metres; 0: 2 % of the diagonal", "type": "number", "minimum": 0, "maximum": 1e9},
            "attribute": {"type": "string"},
            "channel": {"type": "integer", "minimum": 0, "maximum": 3},
            "texture": {"type": "string"}
          }
        },
        "thesis": {"type": "boolean"},
        "preSmoothing": {"type": "integer", "minimum": 0, "maximum": 1000},
        "postSmoothing": {"type": "integer", "minimum": 0, "maximum": 1000},
        "separationAngle": {"description": "degrees", "type": "number", "minimum": 0, "maximum": 180},
        "scaleAxis": {"type": "number", "minimum": 1, "maximum": 10},
        "smallestRadius": {"description": "share of the diagonal", "type": "number", "minimum": 0, "maximum": 1},
        "material": {"description": "of the model, by name", "type": "string"},
        "materials": {"description": "outer material: inner material", "type": "object", "additionalProperties": {"type": "string"}},
        "normals": {"enum": ["smooth", "flat"]},
        "depthColor": {"anyOf": [{"type": "boolean"}, {"type": "string", "pattern": "^(COLOR_[0-9]|_[_A-Z0-9]+)$"}]},
        "roughness": {
          "type": "object", "additionalProperties": false,
          "properties": {
            "amplitude": {"description": "metres", "type": "number", "minimum": 0, "maximum": 1e6},
            "size": {"description": "metres from bump to bump; 0: a twentieth of the diagonal", "type": "number", "minimum": 0, "maximum": 1e6},
            "seed": {"type": "integer", "minimum": 0, "maximum": 1000000000}
          }
        },
        "creaseAngle": {"description": "degrees", "type": "number", "minimum": 0, "maximum": 180},
        "uvMetresPerTile": {"type": "number", "minimum": 0, "maximum": 1e9}
      }
    },
    "physics": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "density": {"description": "kg/m3", "type": "number", "minimum": 1e-6, "maximum": 1e9},
        "friction": {"type": "number", "minimum": 0, "maximum": 100},
        "restitution": {"type": "number", "minimum": 0, "maximum": 1},
        "strength": {"description": "Pa", "type": "number", "minimum": 0, "maximum": 1e15},
        "toughness": {"description": "J/m2", "type": "number", "minimum": 0, "maximum": 1e15},
        "convexParts": {"description": "of a piece's collider, at most", "type": "integer", "minimum": 1, "maximum": 8},
        "hullVertices": {"type": "integer", "minimum": 4, "maximum": 255},
        "hullMargin": {"description": "metres", "type": "number", "minimum": 0, "maximum": 1e6}
      }
    },
    "materials": {
      "description": "by name of a material of the model, which holds for pieces it covers most of, or of a label; what is left out is as in physics",
      "type": "object",
      "additionalProperties": {
        "type": "object", "additionalProperties": false,
        "properties": {
          "density": {"description": "kg/m3", "type": "number", "minimum": 1e-6, "maximum": 1e9},
          "friction": {"type": "number", "minimum": 0, "maximum": 100},
          "restitution": {"type": "number", "minimum": 0, "maximum": 1},
          "strength": {"description": "Pa", "type": "number", "minimum": 0, "maximum": 1e15},
          "toughness": {"description": "J/m2", "type": "number", "minimum": 0, "maximum": 1e15}
        }
      }
    },
    "anchors": {
      "description": "where the world holds the object; places are the scene's, metres",
      "type": "array", "minItems": 1,
      "items": {
        "type": "object", "additionalProperties": false,
        "oneOf": [{"required": ["below"]}, {"required": ["box"]}, {"required": ["label"]}],
        "properties": {
          "below": {
            "description": "a height along y, or a plane",
            "anyOf": [
              {"type": "number", "minimum": -1e9, "maximum": 1e9},
              {
                "type": "object", "additionalProperties": false, "required": ["point"],
                "properties": {
                  "point": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e9, "maximum": 1e9}},
                  "normal": {"description": "upwards, of any length; left out: y", "type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e6, "maximum": 1e6}}
                }
              }
            ]
          },
          "box": {
            "description": "along the axes of the scene",
            "type": "object", "additionalProperties": false, "required": ["min", "max"],
            "properties": {
              "min": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e9, "maximum": 1e9}},
              "max": {"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number", "minimum": -1e9, "maximum": 1e9}}
            }
          },
          "label": {"description": "a piece by its name, as a label of a drawing gives it", "type": "string", "minLength": 1},
          "strength": {"description": "Pa; left out: the piece's own", "type": "number", "minimum": 0, "maximum": 1e15},
          "toughness": {"description": "J/m2; left out: the piece's own", "type": "number", "minimum": 0, "maximum": 1e15}
        }
      }
    },
    "unitScale": {"description": "metres per unit of the model, 0.01 for centimetres; the baked scene is scaled to metres", "type": "number", "minimum": 1e-6, "maximum": 1e6},
    "curveTolerance": {"description": "UV units", "type": "number", "minimum": 1e-7, "maximum": 0.1},
    "seamJoinShare": {"type": "number", "minimum": 0, "maximum": 0.1},
    "minimumComponentShare": {"type": "number", "minimum": 0, "maximum": 0.5},
    "closeGaps": {"type": "number", "minimum": 0, "maximum": 1},
    "snapShare": {"type": "number", "minimum": 0, "maximum": 10},
    "wrap": {"enum": ["texture", "none", "repeat", "mirror", "clamp"]},
    "modelLines": {"type": "boolean"},
    "splitParts": {"type": "boolean"},
    "bitmap": {
      "type": "object", "additionalProperties": false,
      "properties": {
        "threshold": {"type": "number", "minimum": 0, "maximum": 1},
        "tolerance": {"description": "texels", "type": "number", "minimum": 0, "maximum": 1000},
        "spur": {"description": "texels", "type": "number", "minimum": 0, "maximum": 1000},
        "curves": {"type": "boolean"}
      }
    },
    "levelColors": {"description": "stroke colour: level", "type": "object", "additionalProperties": {"type": "integer", "minimum": 1, "maximum": 64}},
    "capHoles": {"type": "boolean"},
    "allowOpen": {"type": "boolean"},
    "measure": {"type": "boolean"}
  }
}
)";

}  // namespace sherd::cli
