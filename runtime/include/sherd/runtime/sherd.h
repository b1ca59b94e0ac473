/* SPDX-License-Identifier: MIT */
/* Sherd from C, and from whatever can call C: the breaking of baked objects over any physics
 * engine. docs/c_interface.md shows it at work.
 *
 * The engine gives a table of functions that make, change and remove bodies; Sherd says which there
 * must be. The engine tells Sherd where bodies are and what hits them. Nothing here throws, and no
 * call takes anything over: memory behind a pointer belongs to whoever made it, for the time of the
 * call; what is returned stays until the world changes, or the asset goes.
 *
 * Handles are numbers. Zero is none; one that is old, made up or of another world does nothing: the
 * call says SHERD_GONE, or returns 0 or null. Null pointers are SHERD_BAD_ARGUMENT. A world belongs
 * to one thread at a time, and none of its calls may be made from within the engine's own functions
 * (SHERD_BUSY); assets are read-only and may be used by all threads.
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

/* Grows when anything here changes. `sherd_abi_version` tells what the library was built with, and
 * `sherd_version` of which release it is, such as "0.1.0". */
#define SHERD_ABI_VERSION 4
SHERD_API uint32_t sherd_abi_version(void);
SHERD_API const char* sherd_version(void);

typedef struct sherd_asset {
    uint64_t id;
} sherd_asset;
typedef struct sherd_world {
    uint64_t id;
} sherd_world;
typedef struct sherd_object {
    uint64_t id;
} sherd_object;

typedef enum sherd_status {
    SHERD_OK = 0,
    SHERD_BAD_ARGUMENT = 1,
    SHERD_MALFORMED = 2, /* the bytes are not sound; the error says where */
    SHERD_NO_MEMORY = 3,
    SHERD_GONE = 4,      /* what the handle named is no more, or the fragment does not stand */
    SHERD_TOO_SMALL = 5, /* the array given holds less than there is */
    SHERD_BUSY = 6       /* called from within a function of the table */
} sherd_status;

/* Where a function takes one, it may be null. Written only when the status is not SHERD_OK. */
typedef struct sherd_error {
    char message[256]; /* what, and what to do; cut off when longer */
    char where[128];   /* JSON pointer into the file, or the argument */
} sherd_error;

typedef struct sherd_pose {
    float translation[3];
    float rotation[4];
} sherd_pose;

/* ---- assets ---- */

/* The objects of a baked GLB. Writes at most `capacity` handles and always `*count`; with
 * SHERD_TOO_SMALL it has made none. */
SHERD_API sherd_status sherd_load(const void* bytes, size_t size, sherd_asset* assets,
                                  uint32_t capacity, uint32_t* count, sherd_error* error);
/* Worlds that use the asset keep it, and its handle, for as long as they live. */
SHERD_API void sherd_asset_release(sherd_asset asset);

/* The same object `factor` times as large and of the same substance, an asset of its own:
 * colliders, masses and what breaking takes are in its size, vertices are the original's. In the
 * size of the original it is the original, by another handle. */
SHERD_API sherd_status sherd_asset_scale(sherd_asset asset, float factor, sherd_asset* out,
                                         sherd_error* error);

typedef struct sherd_asset_info {
    const char* name;
    uint64_t bake_hash; /* tells bakes apart */
    uint32_t fragment_count, level_count, bond_count, material_count;
    uint32_t vertex_count, index_count, attribute_count;
    float diagonal;       /* of the object's bounding box */
    float scale;          /* metres per metre of its vertices */
    sherd_pose rest_pose; /* where the object stands in its own scene */
} sherd_asset_info;
SHERD_API sherd_status sherd_asset_get_info(sherd_asset asset, sherd_asset_info* out);

typedef struct sherd_fragment {
    int32_t parent; /* -1: the object itself, fragment 0 */
    uint32_t first_child, child_count;
    uint32_t level;
    uint32_t hull_count; /* convex colliders */
    const char* name;
    const char* material;
    float mass, volume, density, friction, restitution;
    float strength, toughness; /* Pa, J/m^2 */
    float center_of_mass[3];   /* object frame */
    float low[3], high[3];     /* around its colliders, object frame */
} sherd_fragment;
SHERD_API sherd_status sherd_asset_fragment(sherd_asset asset, uint32_t fragment,
                                            sherd_fragment* out);

/* Points of a fragment's h-th collider, 3 floats each, in the object frame; they lie `margin`
 * inside of what it stands for. */
SHERD_API sherd_status sherd_asset_hull(sherd_asset asset, uint32_t fragment, uint32_t hull,
                                        const float** points, uint32_t* count, float* margin);

/* One vertex and index buffer for all fragments. Attribute 0 is POSITION, 3 floats. */
typedef struct sherd_attribute {
    const char* semantic; /* as in glTF */
    uint32_t components;
    const float* values; /* vertex_count times components */
} sherd_attribute;
SHERD_API sherd_status sherd_asset_attribute(sherd_asset asset, uint32_t attribute,
                                             sherd_attribute* out);
/* Null when the asset is gone. */
SHERD_API const uint32_t* sherd_asset_indices(sherd_asset asset, uint32_t* count);
/* The file's own number of one of the asset's materials; -1: glTF's default, or none such. */
SHERD_API int32_t sherd_asset_material(sherd_asset asset, uint32_t material);

typedef struct sherd_draw_range {
    uint32_t material;     /* index of the asset's materials: the last is the interior's */
    uint32_t exposed_from; /* 0: outer surface; k: hidden until broken to level k */
    uint32_t first_index, index_count;
} sherd_draw_range;
/* What a fragment shows as a body of its own. Writes at most `capacity`; returns how many there
 * are. */
SHERD_API uint32_t sherd_asset_draw_ranges(sherd_asset asset, uint32_t fragment,
                                           sherd_draw_range* out, uint32_t capacity);

#define SHERD_NONE UINT32_MAX
/* Holds two leaves together, or one to the world. */
typedef struct sherd_bond {
    uint32_t a, b; /* fragments; b SHERD_NONE: the world */
    float centroid[3];
    float normal[3]; /* unit, from a to b */
    float area, strength, toughness;
    float energy; /* that breaking it consumes, J */
} sherd_bond;
SHERD_API sherd_status sherd_asset_bond(sherd_asset asset, uint32_t bond, sherd_bond* out);

/* ---- bodies, made by the engine ---- */

typedef struct sherd_motion {
    sherd_pose pose; /* of the body's frame: centre of mass, principal axes */
    float linear_velocity[3];
    float angular_velocity[3];
} sherd_motion;

typedef struct sherd_body {
    uint32_t island; /* number of the body, until it is removed */
    sherd_object object;
    sherd_asset asset;
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
    /* What is not finite, or of no unit quaternion, counts for what was known last. */
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

typedef struct sherd_world_options {
    sherd_damage_options damage; /* for every object; each spawn may add its own */
    uint32_t max_pending_events; /* kept until `sherd_events`; later ones are dropped */
} sherd_world_options;
SHERD_API sherd_world_options sherd_default_world_options(void);

/* All functions of the table must be there. `options` may be null: the defaults. */
SHERD_API sherd_status sherd_world_create(const sherd_body_table* bodies,
                                          const sherd_world_options* options, sherd_world* out,
                                          sherd_error* error);
/* Has the engine remove what bodies there are. */
SHERD_API sherd_status sherd_world_destroy(sherd_world world);

typedef struct sherd_spawn_options {
    sherd_damage_options damage;
    int32_t dynamic; /* 0: stands fixed until something comes off */
    float linear_velocity[3];
    float angular_velocity[3];
} sherd_spawn_options;
SHERD_API sherd_spawn_options sherd_default_spawn_options(void);

/* `options` may be null: the defaults. */
SHERD_API sherd_status sherd_spawn(sherd_world world, sherd_asset asset, const sherd_pose* pose,
                                   const sherd_spawn_options* options, sherd_object* out,
                                   sherd_error* error);
SHERD_API sherd_status sherd_remove(sherd_world world, sherd_object object);
SHERD_API int32_t sherd_is_alive(sherd_world world, sherd_object object);

/* The engine has stepped by so many seconds: asks for the motion of all bodies. Call it before
 * reporting what the step's contacts did. */
SHERD_API sherd_status sherd_after_step(sherd_world world, float seconds);

/* ---- what breaks ---- */

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
SHERD_API sherd_status sherd_report_contact(sherd_world world, const sherd_contact* contact,
                                            float* consumed, sherd_error* error);

/* A hit that is no contact: a ray, a blade. */
typedef struct sherd_hit {
    uint32_t island, fragment;
    float point[3], normal[3];
    float energy, speed, impulse;
} sherd_hit;
SHERD_API sherd_status sherd_report_hit(sherd_world world, const sherd_hit* hit, float* consumed,
                                        sherd_error* error);

typedef enum sherd_shape {
    SHERD_SPHERE = 0,  /* around a */
    SHERD_CAPSULE = 1, /* around the way from a to b */
    SHERD_BOX = 2      /* around a, half as wide as b along the axes of rotation; of no radius */
} sherd_shape;
/* Energy let loose on a region of the world. */
typedef struct sherd_area_damage {
    int32_t shape; /* a sherd_shape */
    float a[3], b[3];
    float rotation[4];
    float radius;
    float fluence;  /* J per m^2 of bond, in the core; infinity breaks whatever is inside */
    float falloff;  /* share of the radius over which it falls evenly to nothing, 0..1 */
    float shear[3]; /* unit: bonds feel what of a motion in this direction shears them; 0: all */
} sherd_area_damage;
SHERD_API sherd_area_damage sherd_default_area_damage(void);
/* `broken`, bonds, may be null. */
SHERD_API sherd_status sherd_damage(sherd_world world, sherd_object object,
                                    const sherd_area_damage* damage, uint32_t* broken,
                                    sherd_error* error);
/* The same to every object of the world. */
SHERD_API sherd_status sherd_damage_all(sherd_world world, const sherd_area_damage* damage,
                                        uint32_t* broken, sherd_error* error);

/* Breaks a standing fragment out of its neighbours and into its children. */
SHERD_API sherd_status sherd_break_fragment(sherd_world world, sherd_object object,
                                            uint32_t fragment);
/* Out of its neighbours, whole. */
SHERD_API sherd_status sherd_detach(sherd_world world, sherd_object object, uint32_t fragment);
SHERD_API sherd_status sherd_break_all(sherd_world world, sherd_object object);
/* Gives bonds that are not broken `share` of their energy back, 0..1. */
SHERD_API sherd_status sherd_heal(sherd_world world, sherd_object object, float share);

/* Holds all leaves of a fragment to the world, or lets them go again. */
SHERD_API sherd_status sherd_anchor(sherd_world world, sherd_object object, uint32_t fragment,
                                    int32_t anchored);
/* Holds the leaves whose colliders' bounds reach into a box of the world; `leaves` (how many) may
 * be null. */
SHERD_API sherd_status sherd_anchor_in_box(sherd_world world, sherd_object object,
                                           const float low[3], const float high[3],
                                           uint32_t* leaves);

/* Lets anchored objects that have changed find out what their bonds carry at rest, so many
 * iterations at most, and breaks what is overloaded: once a step. */
SHERD_API sherd_status sherd_work_on_stress(sherd_world world, const float gravity[3],
                                            uint32_t iterations);

/* ---- saved games, late joiners ---- */

/* An object's damage, bodies and motion, to the bit. Writes `*size`, and the bytes when they are at
 * most `capacity` (else SHERD_TOO_SMALL). */
SHERD_API sherd_status sherd_save(sherd_world world, sherd_object object, void* bytes,
                                  size_t capacity, size_t* size);
/* Gives an object that was spawned of the same bake the state another one had. Fires no events.
 * Bytes are checked before anything changes; what an adapter for another engine saved of its own is
 * left out. */
SHERD_API sherd_status sherd_restore(sherd_world world, sherd_object object, const void* bytes,
                                     size_t size, sherd_error* error);

/* ---- what to draw, to hear and to ask ---- */

typedef struct sherd_fragment_pose {
    sherd_object object;
    sherd_asset asset;
    uint32_t fragment;
    sherd_pose pose;     /* of the object frame: the asset's vertices, scaled */
    sherd_pose previous; /* a step ago */
    float scale;         /* of the asset */
} sherd_fragment_pose;
/* Valid until the next call that changes anything. Null when the world is gone or has none. */
SHERD_API const sherd_fragment_pose* sherd_poses(sherd_world world, uint32_t* count);

typedef struct sherd_break_event {
    sherd_object object;
    sherd_asset asset;
    uint32_t fragment, level, bonds, bodies;
    float area;
    float point[3], normal[3];
    float impulse, energy, consumed, approach_speed;
    double time;
} sherd_break_event;
/* Since the last call; valid until the next. */
SHERD_API const sherd_break_event* sherd_events(sherd_world world, uint32_t* count);

typedef struct sherd_island {
    sherd_object object;
    sherd_asset asset;
    const uint32_t* fragments; /* ascending; valid until the next call that changes anything */
    uint32_t fragment_count;
    int32_t is_fixed, is_anchored;
    double age;      /* seconds since it came off; infinite of what has not */
    sherd_pose pose; /* of the object frame */
} sherd_island;
SHERD_API sherd_status sherd_get_island(sherd_world world, uint32_t island, sherd_island* out);
/* The island of a standing fragment; SHERD_NONE. */
SHERD_API uint32_t sherd_find_island(sherd_world world, sherd_object object, uint32_t fragment);
/* How many islands an object is; 0: it is gone. */
SHERD_API uint32_t sherd_island_count(sherd_world world, sherd_object object);

/* What is left of a bond: 1 sound, 0 broken; -1: there is none. */
SHERD_API float sherd_bond_health(sherd_world world, sherd_object object, uint32_t bond);
/* The same of all bonds of a fragment, by area; 1 when it has none, -1: there is no such fragment.
 */
SHERD_API float sherd_fragment_health(sherd_world world, sherd_object object, uint32_t fragment);
/* What a fragment, of any level, must carry beside its weight until this is called for it again: N,
 * world, at its centre of mass; zero: nothing. It strains the bonds of what is anchored, also
 * within what is whole yet, and moves nothing. */
SHERD_API sherd_status sherd_set_load(sherd_world world, sherd_object object, uint32_t fragment,
                                      const float force[3]);

/* How many bodies hits, area damage and load may still make, and how many of them may move, until
 * the next call: where there would be more, there are fewer and larger ones now. UINT32_MAX, as
 * without any call: no limit. */
SHERD_API sherd_status sherd_allow_bodies(sherd_world world, uint32_t bodies, uint32_t moving);

/* Takes the body that a standing fragment is part of out for good. What is left of the object
 * stays, also when nothing is. */
SHERD_API sherd_status sherd_remove_piece(sherd_world world, sherd_object object,
                                          uint32_t fragment);

/* How overloaded a bond is, of the anchored object that was solved last: > 1 breaks; 0: not known.
 */
SHERD_API float sherd_overload(sherd_world world, sherd_object object, uint32_t bond);

/* What a standing fragment holds on to. */
typedef struct sherd_neighbor {
    uint32_t fragment; /* SHERD_NONE: the world */
    float area;        /* of bonds that are not broken */
    float health;      /* what is left of all bonds between the two, by area */
} sherd_neighbor;
/* Ascending, the world last. Writes at most `capacity`; returns how many there are. */
SHERD_API uint32_t sherd_neighbors(sherd_world world, sherd_object object, uint32_t fragment,
                                   sherd_neighbor* out, uint32_t capacity);

#ifdef __cplusplus
}
#endif

#endif
