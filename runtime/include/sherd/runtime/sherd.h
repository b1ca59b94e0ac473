/* SPDX-License-Identifier: MIT */
/* Sherd from C, and from whatever can call C: the breaking of baked objects over any physics
 * engine.
 *
 * The engine gives a table of functions that make, change and remove bodies; Sherd says which there
 * must be. The engine tells Sherd where bodies are and what hits them. Nothing here throws, and no
 * call takes anything over: memory behind a pointer belongs to whoever made it. A world and what it
 * lists belong to one thread at a time; assets are read-only and may be shared by all.
 *
 * Units are SI. Vectors are x, y, z; quaternions x, y, z, w, of unit length. */
#ifndef SHERD_H
#define SHERD_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define SHERD_API __declspec(dllexport)
#else
#define SHERD_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Grows when anything here changes. `sherd_abi_version` tells what the library was built with. */
#define SHERD_ABI_VERSION 1
SHERD_API uint32_t sherd_abi_version(void);

typedef struct sherd_asset sherd_asset;
typedef struct sherd_world sherd_world;

typedef enum sherd_status {
    SHERD_OK = 0,
    SHERD_BAD_ARGUMENT = 1,
    SHERD_MALFORMED = 2, /* the bytes are no sound file; the error says where */
    SHERD_NO_MEMORY = 3,
    SHERD_GONE = 4,     /* the object was removed, or the fragment does not stand */
    SHERD_TOO_SMALL = 5 /* the array given holds less than there is */
} sherd_status;

typedef struct sherd_error {
    char message[256]; /* what, and what to do; cut off when longer */
    char where[128];   /* JSON pointer into the file, or the argument */
} sherd_error;

typedef struct sherd_pose {
    float translation[3];
    float rotation[4];
} sherd_pose;

typedef struct sherd_object {
    uint32_t index;
    uint32_t generation;
} sherd_object;

/* ---- assets ---- */

/* The objects of a baked GLB. Writes at most `capacity` handles and always `*count`; with
 * SHERD_TOO_SMALL it has made none. `error` may be null. */
SHERD_API sherd_status sherd_load(const void* bytes, size_t size, sherd_asset** assets,
                                  uint32_t capacity, uint32_t* count, sherd_error* error);
/* Bodies and worlds that use the asset keep what they need of it. Null does nothing. */
SHERD_API void sherd_asset_release(sherd_asset* asset);

SHERD_API const char* sherd_asset_name(const sherd_asset* asset);
SHERD_API uint64_t sherd_asset_bake_hash(const sherd_asset* asset);
SHERD_API uint32_t sherd_asset_fragment_count(const sherd_asset* asset);

typedef struct sherd_fragment {
    int32_t parent; /* -1: the object itself */
    uint32_t first_child, child_count;
    uint32_t level;
    uint32_t hull_count; /* convex colliders */
    const char* name;
    const char* material;
    float mass, volume, density, friction, restitution;
    float center_of_mass[3]; /* object frame */
} sherd_fragment;
SHERD_API sherd_status sherd_asset_fragment(const sherd_asset* asset, uint32_t fragment,
                                            sherd_fragment* out);

/* Points of a fragment's h-th collider, 3 floats each, in the object frame; they lie `margin`
 * inside of what it stands for. */
SHERD_API sherd_status sherd_asset_hull(const sherd_asset* asset, uint32_t fragment, uint32_t hull,
                                        const float** points, uint32_t* count, float* margin);

/* One vertex and index buffer for all fragments. Attribute 0 is POSITION, 3 floats. */
typedef struct sherd_attribute {
    const char* semantic; /* as in glTF */
    uint32_t components;
    const float* values; /* vertex_count times components */
} sherd_attribute;
SHERD_API uint32_t sherd_asset_vertex_count(const sherd_asset* asset);
SHERD_API uint32_t sherd_asset_attribute_count(const sherd_asset* asset);
SHERD_API sherd_status sherd_asset_attribute(const sherd_asset* asset, uint32_t attribute,
                                             sherd_attribute* out);
SHERD_API const uint32_t* sherd_asset_indices(const sherd_asset* asset, uint32_t* count);

typedef struct sherd_draw_range {
    uint32_t material;     /* index of the asset's materials: the last is the interior's */
    uint32_t exposed_from; /* 0: outer surface; k: hidden until broken to level k */
    uint32_t first_index, index_count;
} sherd_draw_range;
/* What a fragment shows as a body of its own. Writes at most `capacity`; returns how many there
 * are. */
SHERD_API uint32_t sherd_asset_draw_ranges(const sherd_asset* asset, uint32_t fragment,
                                           sherd_draw_range* out, uint32_t capacity);

/* ---- bodies, made by the engine ---- */

typedef struct sherd_motion {
    sherd_pose pose; /* of the body's frame: centre of mass, principal axes */
    float linear_velocity[3];
    float angular_velocity[3];
} sherd_motion;

typedef struct sherd_body {
    uint32_t island; /* number of the body, until it is removed */
    sherd_object object;
    const sherd_asset* asset;
    const uint32_t* fragments; /* whose colliders make it up, ascending; valid during the call */
    uint32_t fragment_count;
    float mass;       /* 0: it stands fixed */
    float inertia[3]; /* along the axes of the frame */
    float friction, restitution;
    sherd_pose frame; /* body to object: colliders go through its inverse */
    sherd_motion motion;
} sherd_body;

typedef struct sherd_body_table {
    void* user; /* first argument of all */
    void (*create)(void* user, const sherd_body* body);
    /* The body stays, and what it consists of changes: shape, mass, centre, motion. */
    void (*update)(void* user, const sherd_body* body);
    void (*remove)(void* user, uint32_t island);
    void (*get_motion)(void* user, uint32_t island, sherd_motion* out);
} sherd_body_table;

/* ---- worlds ---- */

typedef struct sherd_damage_options {
    float toughness_scale, strength_scale, level_scale;
    float minimum_impulse, minimum_energy;
    float immunity;
    uint32_t max_level;
} sherd_damage_options;
/* As in damage.h. */
SHERD_API sherd_damage_options sherd_default_damage_options(void);

/* All functions of the table must be there. Null: no memory, or one is missing. */
SHERD_API sherd_world* sherd_world_create(const sherd_body_table* bodies);
/* Has the engine remove what bodies there are. Null does nothing. */
SHERD_API void sherd_world_destroy(sherd_world* world);

typedef struct sherd_spawn_options {
    sherd_damage_options damage;
    int32_t dynamic; /* 0: stands fixed until something comes off */
    float linear_velocity[3];
    float angular_velocity[3];
} sherd_spawn_options;
SHERD_API sherd_spawn_options sherd_default_spawn_options(void);

/* `options` may be null: the defaults. */
SHERD_API sherd_status sherd_spawn(sherd_world* world, const sherd_asset* asset,
                                   const sherd_pose* pose, const sherd_spawn_options* options,
                                   sherd_object* out);
SHERD_API sherd_status sherd_remove(sherd_world* world, sherd_object object);
SHERD_API int32_t sherd_is_alive(const sherd_world* world, sherd_object object);

/* The engine has stepped by so many seconds: asks for the motion of all bodies. Call it before
 * reporting what the step's contacts did. */
SHERD_API sherd_status sherd_after_step(sherd_world* world, float seconds);

/* All that one pair of bodies did to each other in a step, summed over its points. */
typedef struct sherd_contact {
    uint32_t island;
    uint32_t fragment; /* of the island, that was touched */
    float point[3];
    float normal[3];      /* unit, into the island */
    float impulse;        /* along the normal, N s */
    float approach_speed; /* along the normal before the step, without what gravity added in it */
    float effective_mass; /* 1 / (1/m_a + 1/m_b) with rotation, at the point along the normal */
} sherd_contact;
/* Breaks what that breaks. `consumed`, J, may be null: the engine takes it from the motion of the
 * two, and should give the hitter its velocity from before the contact first. */
SHERD_API sherd_status sherd_report_contact(sherd_world* world, const sherd_contact* contact,
                                            float* consumed);

/* A hit that is no contact: a ray, a blade. */
typedef struct sherd_hit {
    uint32_t island, fragment;
    float point[3], normal[3];
    float energy, speed, impulse;
} sherd_hit;
SHERD_API sherd_status sherd_report_hit(sherd_world* world, const sherd_hit* hit, float* consumed);

/* Energy let loose in a sphere, J per m^2 of bond in its core, falling evenly over a share of the
 * radius. `broken`, bonds, may be null. */
SHERD_API sherd_status sherd_damage_sphere(sherd_world* world, sherd_object object,
                                           const float center[3], float radius, float fluence,
                                           float falloff, uint32_t* broken);
SHERD_API sherd_status sherd_break_fragment(sherd_world* world, sherd_object object,
                                            uint32_t fragment);
SHERD_API sherd_status sherd_break_all(sherd_world* world, sherd_object object);
SHERD_API sherd_status sherd_anchor(sherd_world* world, sherd_object object, uint32_t fragment,
                                    int32_t anchored);

/* ---- what to draw and to hear ---- */

typedef struct sherd_fragment_pose {
    sherd_object object;
    const sherd_asset* asset;
    uint32_t fragment;
    sherd_pose pose;     /* of the object frame: the asset's vertices */
    sherd_pose previous; /* a step ago */
} sherd_fragment_pose;
/* Valid until the next call that changes anything. */
SHERD_API const sherd_fragment_pose* sherd_poses(sherd_world* world, uint32_t* count);

typedef struct sherd_break_event {
    sherd_object object;
    const sherd_asset* asset;
    uint32_t fragment, level, bonds, bodies;
    float area;
    float point[3], normal[3];
    float impulse, energy, consumed, approach_speed;
    double time;
} sherd_break_event;
/* Since the last call; valid until the next. */
SHERD_API const sherd_break_event* sherd_events(sherd_world* world, uint32_t* count);

/* What is left of a bond: 1 sound, 0 broken; -1: there is none. */
SHERD_API uint32_t sherd_asset_bond_count(const sherd_asset* asset);
SHERD_API float sherd_bond_health(const sherd_world* world, sherd_object object, uint32_t bond);

#ifdef __cplusplus
}
#endif

#endif
