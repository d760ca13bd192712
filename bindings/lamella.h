/* The C interface of Lamella: recipes, sections and whole jobs, for C and every language that can call C.
 *
 * Lengths are millimetres in the part's own coordinates, areas mm^2, volumes mm^3. Text is UTF-8 and ends
 * in a zero. Numbers in text have a decimal point whatever the locale.
 *
 * STATUS. A function that can fail returns a status: LAMELLA_OK or the kind of failure. lamella_last_error
 * returns the details of a context's last failure. No function throws, prints, exits or changes process
 * state that other code sees. After a failure, out-parameters are unchanged unless the function says
 * otherwise.
 *
 * STRUCTS. The first member of every struct is its size in the caller's program. The library neither reads
 * nor writes beyond it, so that programs built against an older header keep working. Clear a struct, then
 * set its struct_size: in C, `lamella_job_info info = {.struct_size = sizeof info};`. Zero in any other
 * member selects the default.
 *
 * MEMORY. Objects that a function named lamella_..._create, _read, _build or _open returns, and contours
 * and runs, are released by the function named _destroy, which accepts a null pointer. Other pointers that
 * the library returns are valid as long as the object that they came from. Pointers given to a callback
 * are valid until the callback returns. The library keeps no pointer of the caller's after a call, except
 * callbacks and their `user`: these must stay valid as long as anything made with them lives.
 *
 * THREADS. There is no state outside the objects. A context, a recipe and a section may be used by one
 * thread at a time; give each thread its own. A job, contours and runs never change: any number of threads
 * may query them at once, each with its own context. A cancel token may be set from any thread, and from a
 * signal handler. Callbacks for fields, gradings and the rendering of layers are called by several threads
 * at once. A callback may call the library with a context of its own.
 *
 * EXAMPLE. The area of the section at z = 3 mm of a part; error handling and release are left out:
 * ```
 *     lamella_context* context;
 *     lamella_recipe* recipe;
 *     lamella_job* job;
 *     lamella_section* section;
 *     lamella_contours* contours;
 *     lamella_contours_view view = {.struct_size = sizeof view};
 *     lamella_context_create(LAMELLA_ABI_VERSION, &context);
 *     lamella_recipe_read(context, "part.toml", &recipe);
 *     lamella_job_build(context, recipe, NULL, &job);
 *     lamella_section_open(context, job, 3.0, &section);
 *     lamella_section_contours(context, section, LAMELLA_PART, 0.01, &contours);
 *     lamella_contours_view_get(context, contours, &view);
 *     printf("%g mm^2 in %zu contours\n", view.area, view.count);
 * ```
 */
#ifndef LAMELLA_H
#define LAMELLA_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define LAMELLA_API __attribute__((visibility("default")))
#else
#define LAMELLA_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Versions and statuses ------------------------------------------------------------------------- */

/* The version of the binary interface. It grows when programs built against an older header would stop
 * working. */
#define LAMELLA_ABI_VERSION 1u

/* Statuses. Those that are also exit codes of the command have the same numbers. */
enum {
    LAMELLA_OK = 0,
    LAMELLA_VIOLATED = 1,      /* a stated constraint is violated */
    LAMELLA_BAD_INPUT = 2,     /* a file, a key or a value is wrong */
    LAMELLA_FAULT = 3,         /* the disk is full, the printer is gone, a callback failed */
    LAMELLA_BAD_CALL = 4,      /* a null pointer, or an invalid size or number */
    LAMELLA_OUT_OF_MEMORY = 5, /* there is not enough memory */
    LAMELLA_STOPPED = 130      /* a cancel token was set, or a callback asked to stop */
};

/* Returns the interface version of the library; compare it with LAMELLA_ABI_VERSION. */
LAMELLA_API uint32_t lamella_abi_version(void);
/* Returns the version of the library, "0.2.0". */
LAMELLA_API const char* lamella_version(void);
/* Returns a status as words: "ok", "bad input", ... */
LAMELLA_API const char* lamella_status_name(int32_t status);

/* ---- Contexts: what a thread needs to call ---------------------------------------------------------- */

typedef struct lamella_context lamella_context;

typedef struct lamella_error {
    uint32_t struct_size;
    int32_t status;      /* LAMELLA_OK when nothing has failed yet */
    const char* message; /* what was wrong and what is accepted; a line for each mistake of a recipe */
    /* path of the recipe with the first mistake; "" when the failure is not about a line of a recipe */
    const char* path;
    int32_t line; /* line in that recipe, counted from 1; 0 when the failure is not about a line */
} lamella_error;

/* Makes a context. `abi_version` must be LAMELLA_ABI_VERSION; returns LAMELLA_BAD_CALL when the library
 * has another version. */
LAMELLA_API int32_t lamella_context_create(uint32_t abi_version, lamella_context** context);
LAMELLA_API void lamella_context_destroy(lamella_context* context);
/* Fills in the last failure of a call with this context. Its texts are valid until the next call with it. */
LAMELLA_API int32_t lamella_last_error(const lamella_context* context, lamella_error* error);

/* ---- Cancel tokens: stopping long work -------------------------------------------------------------- */

typedef struct lamella_cancel lamella_cancel;

LAMELLA_API int32_t lamella_cancel_create(lamella_context* context, lamella_cancel** cancel);
/* To be called only when nothing uses the token any more. */
LAMELLA_API void lamella_cancel_destroy(lamella_cancel* cancel);
/* Asks all work that has this token to stop. May be called from any thread or signal handler. Work checks
 * its token every few milliseconds, between the steps of a layer too; single steps of the heaviest layers
 * take some tens of milliseconds. */
LAMELLA_API void lamella_cancel_request(lamella_cancel* cancel);

/* ---- Recipes: what to make -------------------------------------------------------------------------- */

typedef struct lamella_recipe lamella_recipe;

/* Makes an empty recipe. */
LAMELLA_API int32_t lamella_recipe_create(lamella_context* context, lamella_recipe** recipe);
LAMELLA_API void lamella_recipe_destroy(lamella_recipe* recipe);
/* Reads a recipe (.toml), or takes a model (.stl, .obj, .ply, .3mf) as the part. A file that cannot be
 * read or is not valid TOML fails here. All other mistakes are reported together, when a job is built. */
LAMELLA_API int32_t lamella_recipe_read(lamella_context* context, const char* path, lamella_recipe** recipe);
/* Adds the sections of a recipe given as text of `size` bytes. Its values replace earlier ones. `name`
 * stands for the text in messages; relative paths in the text start in the folder of `name`. */
LAMELLA_API int32_t lamella_recipe_add_text(lamella_context* context, lamella_recipe* recipe,
                                            const char* text, size_t size, const char* name);
/* Sets a key for which the command has a flag, for example "foam.cell" to "2.5 + 0.1*z". The value has
 * precedence over those of texts and files. An unknown key is LAMELLA_BAD_INPUT at once; a wrong value is
 * reported when a job is built. */
LAMELLA_API int32_t lamella_recipe_set(lamella_context* context, lamella_recipe* recipe, const char* key,
                                       const char* value);
/* Adds a folder of machine profiles to the built-in ones; null: the user's own profile folder. */
LAMELLA_API int32_t lamella_recipe_add_printers(lamella_context* context, lamella_recipe* recipe,
                                                const char* folder);

/* How the values of the caller's field relate to the distance from its surface. */
enum {
    LAMELLA_SIGN = 0,  /* only the sign has a meaning; slow, since no region can be skipped */
    LAMELLA_BOUND = 1, /* it changes by at most 1 per mm (a lower bound of the distance) */
    LAMELLA_EXACT = 2  /* it is the signed Euclidean distance, mm */
};

/* Encloses all values in the box from lower to upper (x, y, z each): sets `least` and `greatest`. These
 * may be infinite or further apart than necessary. Several threads call it at once. */
typedef int32_t (*lamella_range)(void* user, const double* lower, const double* upper, double* least,
                                 double* greatest);

/* A solid of the caller's: the points at which `values` is below zero. */
typedef struct lamella_field {
    uint32_t struct_size;
    int32_t metric;            /* LAMELLA_SIGN, LAMELLA_BOUND or LAMELLA_EXACT */
    double lower[3], upper[3]; /* a box around the solid, mm; the solid is cut off at it */
    /* Writes the values at `count` points (x, y, z each, mm) to `values`; anything but 0 is a failure.
     * Several threads call it at once. The same point must get the same value each time. */
    int32_t (*values)(void* user, const double* points, size_t count, double* values);
    void* user;
    /* Identifies this function. Jobs that are otherwise equal must make equal layers when their identities
     * are equal, and may make different ones when not. A stopped run is recognised by it. Not null. */
    const char* identity;
    lamella_range range; /* may be null: values are then bounded by `metric` alone */
} lamella_field;

/* A number of the caller's that varies in space (a grading). */
typedef struct lamella_grading {
    uint32_t struct_size;
    double least, greatest; /* values outside this range are clamped to it */
    int32_t (*values)(void* user, const double* points, size_t count,
                      double* values); /* as in lamella_field */
    void* user;
    const char* identity; /* as in lamella_field */
    /* May be null: foams are then built for any number from `least` to `greatest` everywhere, which takes
     * longer the further these are apart. With it, foams equal those of the same formula in a recipe. */
    lamella_range range;
} lamella_grading;

/* A mesh of the caller's. It is copied and repaired like a mesh file: holes are closed, defects mended. */
typedef struct lamella_mesh {
    uint32_t struct_size;
    const double* vertices; /* x, y, z each, mm */
    size_t vertex_count;
    const uint32_t* triangles; /* three vertices each, counter-clockwise seen from outside */
    size_t triangle_count;
} lamella_mesh;

/* These two give the recipe a named solid, like a [[field]]. It is the part if it is the only one;
 * "part.field" and regions may refer to it. The recipe's text may declare it with kind = "host". */
LAMELLA_API int32_t lamella_recipe_add_field(lamella_context* context, lamella_recipe* recipe,
                                             const char* name, const lamella_field* field);
LAMELLA_API int32_t lamella_recipe_add_mesh(lamella_context* context, lamella_recipe* recipe,
                                            const char* name, const lamella_mesh* mesh);
/* Gives the recipe a number that formulas can use by its name, like a [[grading]]. */
LAMELLA_API int32_t lamella_recipe_add_grading(lamella_context* context, lamella_recipe* recipe,
                                               const char* name, const lamella_grading* grading);

/* ---- Jobs: a recipe made ----------------------------------------------------------------------------- */

typedef struct lamella_job lamella_job;

/* Receives the progress of work; anything but 0 stops it. `what` is "layers", "islands", "repairs" or
 * "supports". */
typedef int32_t (*lamella_on_progress)(void* user, const char* what, int32_t done, int32_t total);

typedef struct lamella_build_options {
    uint32_t struct_size;
    int32_t threads;        /* 0: one per core */
    lamella_cancel* cancel; /* may be null */
    lamella_on_progress
        progress; /* of searches and surveys before the first layer, if the recipe needs any; may be null */
    void* user;
    /* folder in which supports and optimised parts are kept for later runs; null: none are kept */
    const char* plans;
} lamella_build_options;

typedef struct lamella_job_info {
    uint32_t struct_size;
    int32_t layer_count;
    double lower[3], upper[3]; /* bounds of part and supports; the bed lies at lower[2] */
    double layer_height;       /* of the first layer, mm; see lamella_job_layer_height() */
    int32_t has_supports;      /* 1 or 0 */
    const char* name;          /* of the part */
    const char* identity;      /* 32 hexadecimal digits; jobs with equal ones make equal layers */
} lamella_job_info;

/* Makes the job of a recipe, which may be changed or destroyed afterwards. `options` may be null. */
LAMELLA_API int32_t lamella_job_build(lamella_context* context, const lamella_recipe* recipe,
                                      const lamella_build_options* options, lamella_job** job);
/* Objects made from the job stay valid: they share ownership of what they need. */
LAMELLA_API void lamella_job_destroy(lamella_job* job);
LAMELLA_API int32_t lamella_job_info_get(lamella_context* context, const lamella_job* job,
                                         lamella_job_info* info);
/* Returns how high a layer is, mm. */
LAMELLA_API int32_t lamella_job_layer_height(lamella_context* context, const lamella_job* job, int32_t layer,
                                             double* height);
/* Returns the height at which a layer is cut, half-way up the layer: mm in part coordinates. */
LAMELLA_API int32_t lamella_job_layer_z(lamella_context* context, const lamella_job* job, int32_t layer,
                                        double* z);
/* Writes the values of the part's field at `count` points (x, y, z each, mm): below zero inside. */
LAMELLA_API int32_t lamella_job_values(lamella_context* context, const lamella_job* job, const double* points,
                                       size_t count, double* values);

/* How the part bears the [[load]]s of its recipe. Compliances are weighted sums over the load cases. */
typedef struct lamella_structure {
    uint32_t struct_size;
    int32_t dimensions;          /* 2 for a plate, else 3 */
    int32_t iterations;          /* of the search that made the part; 0: it was only analysed */
    int32_t converged;           /* 1: the search ended by its tolerance */
    double element;              /* edge of the finite elements along x, mm */
    double full_compliance;      /* with material everywhere, N mm */
    double compliance;           /* of the part, N mm */
    double volume;               /* share of the body that is solid; 0: not known, of a foam by its law */
    double mass;                 /* g; 0: the material's density is not known */
    double largest_displacement; /* over all load cases, mm */
    double peak_stress;          /* von Mises, over all load cases, MPa; 0 of a foam by its law */
    double appearance;           /* difference from the picture of [optimize]; 0: there is none */
    double stiffest_appearance;  /* the same of the stiffest part with as much material */
} lamella_structure;

enum {
    LAMELLA_MODEL_AUTOMATIC = 0, /* by the foam's law if it has a known one, else by elements */
    LAMELLA_MODEL_ELEMENTS = 1,  /* elements inside the part: struts need four or more across */
    LAMELLA_MODEL_LAW = 2
};

typedef struct lamella_analysis_options {
    uint32_t struct_size;
    int32_t model;          /* LAMELLA_MODEL_... */
    int32_t elements;       /* along the part's longest side; 0: those of [optimize], else a usual number */
    int32_t threads;        /* 0: one per core */
    lamella_cancel* cancel; /* may be null */
} lamella_analysis_options;

/* Analyses a job's part. Without options it is the result of the search, if the recipe has [optimize] and the
 * result does not come from a plan. */
LAMELLA_API int32_t lamella_job_structure(lamella_context* context, const lamella_job* job,
                                          const lamella_analysis_options* options,
                                          lamella_structure* structure);

/* ---- Sections: a job at one height ------------------------------------------------------------------- */

typedef struct lamella_section lamella_section;

/* Values of `what`; they may be combined with |. */
enum { LAMELLA_PART = 1, LAMELLA_SUPPORTS = 2 };

typedef struct lamella_section_info {
    uint32_t struct_size;
    int32_t layer;    /* -1 where the section was opened at a height */
    double z;         /* mm */
    double thickness; /* of a layer, mm */
    double lower[2],
        upper[2]; /* bounding rectangle of part and supports, mm; lower > upper when the section is empty */
} lamella_section_info;

/* Cuts the job at any height, mm in part coordinates. */
LAMELLA_API int32_t lamella_section_open(lamella_context* context, const lamella_job* job, double z,
                                         lamella_section** section);
/* Cuts the job at the height at which a layer is cut. */
LAMELLA_API int32_t lamella_section_open_layer(lamella_context* context, const lamella_job* job,
                                               int32_t layer, lamella_section** section);
LAMELLA_API void lamella_section_destroy(lamella_section* section);
LAMELLA_API int32_t lamella_section_info_get(lamella_context* context, const lamella_section* section,
                                             lamella_section_info* info);

/* A pixel grid in the plane: the corner of pixel (column 0, row 0), and the steps to the next ones. */
typedef struct lamella_raster {
    uint32_t struct_size;
    int32_t columns, rows;
    /* sampled lines per row, whose mean is the coverage; 0: a pixel is solid if its centre is */
    int32_t lines;
    double x, y;             /* mm */
    double pitch_x, pitch_y; /* mm from column to column and from row to row; negative to mirror */
} lamella_raster;

/* Writes the solid share of each pixel, 0 to 255, to `pixels`: row by row, with `stride` bytes from one
 * row to the next (0: as many as there are columns). */
LAMELLA_API int32_t lamella_section_coverage(lamella_context* context, lamella_section* section, int32_t what,
                                             const lamella_raster* raster, uint8_t* pixels, size_t stride);

/* The solid runs of every line of a raster. */
typedef struct lamella_runs lamella_runs;
typedef struct lamella_runs_view {
    uint32_t struct_size;
    size_t line_count;   /* rows times lines per row */
    const size_t* first; /* index of the first run of each line; line_count + 1 of them */
    const int32_t* ends; /* begin and end of each run along its line, half-open, in 1/256 of a column */
} lamella_runs_view;

LAMELLA_API int32_t lamella_section_runs(lamella_context* context, lamella_section* section, int32_t what,
                                         const lamella_raster* raster, lamella_runs** runs);
LAMELLA_API void lamella_runs_destroy(lamella_runs* runs);
LAMELLA_API int32_t lamella_runs_view_get(lamella_context* context, const lamella_runs* runs,
                                          lamella_runs_view* view);

/* Closed polygons without crossings: outer ones counter-clockwise, holes clockwise. */
typedef struct lamella_contours lamella_contours;
typedef struct lamella_contours_view {
    uint32_t struct_size;
    size_t count;          /* of contours */
    const size_t* first;   /* index of the first point of each contour; count + 1 of them */
    const double* points;  /* x, y each, mm; the first point is not repeated */
    const int32_t* parent; /* the contour that directly encloses this one; -1 when there is none */
    double area;           /* enclosed area, holes subtracted, mm^2 */
} lamella_contours_view;

/* Traces the contours of the section, which deviate from the solid's border by at most `tolerance`, mm. */
LAMELLA_API int32_t lamella_section_contours(lamella_context* context, lamella_section* section, int32_t what,
                                             double tolerance, lamella_contours** contours);

/* Polygons of the caller's under the even-odd rule: a point inside an odd number of them is inside. */
typedef struct lamella_polygons {
    uint32_t struct_size;
    size_t count;         /* of polygons */
    const size_t* first;  /* index of the first point of each polygon; count + 1 of them */
    const double* points; /* x, y each, mm */
} lamella_polygons;

/* Returns the contours of the section intersected with the polygons: these are filled with the job's foam
 * at this height. `tolerance` as in lamella_section_contours. */
LAMELLA_API int32_t lamella_section_fill(lamella_context* context, lamella_section* section, int32_t what,
                                         const lamella_polygons* inside, double tolerance,
                                         lamella_contours** contours);
LAMELLA_API void lamella_contours_destroy(lamella_contours* contours);
LAMELLA_API int32_t lamella_contours_view_get(lamella_context* context, const lamella_contours* contours,
                                              lamella_contours_view* view);

/* ---- Runs: layers into a back-end -------------------------------------------------------------------- */

enum {
    LAMELLA_RESUME = 1, /* continue an unfinished output of the same job */
    LAMELLA_FORCE = 2   /* replace an output that exists */
};

typedef struct lamella_run_options {
    uint32_t struct_size;
    int32_t threads;              /* 0: one per core */
    int32_t look_ahead;           /* layers in flight at most; 0: two per thread */
    int32_t first, last;          /* range of layers, `last` excluded; both 0: all */
    uint32_t flags;               /* LAMELLA_RESUME, LAMELLA_FORCE */
    lamella_cancel* cancel;       /* may be null */
    lamella_on_progress progress; /* called by one thread after each layer; may be null */
    void* user;
} lamella_run_options;

typedef struct lamella_run_report {
    uint32_t struct_size;
    int32_t layers_written;
    int32_t layers_kept;   /* found finished by a resumed run */
    double volume;         /* material of the part in the layers written, mm^3 */
    double support_volume; /* material of its supports, mm^3 */
} lamella_run_report;

/* Streams the job's layers to a file or folder, like `lamella slice -o`. `output` is PATH, or PATH@PROFILE
 * for a machine other than the recipe's. A path's ending that belongs to a back-end selects it. `options`
 * and `report` may be null. A run that stops or fails leaves its finished layers under an unfinished name,
 * for LAMELLA_RESUME. Messages use the command's flags: --output means `output`, --resume and --force mean
 * `flags` of the options. */
LAMELLA_API int32_t lamella_run(lamella_context* context, const lamella_job* job, const char* output,
                                const lamella_run_options* options, lamella_run_report* report);

/* The result of rendering one layer by a back-end of the caller's. */
typedef struct lamella_product {
    uint32_t struct_size;
    void* data;          /* the caller's data; passed to `write`, then to `drop` */
    double area;         /* solid area of the part, mm^2, for the report; 0 when unknown */
    double support_area; /* solid area of its supports, mm^2 */
} lamella_product;

/* A back-end of the caller's. A callback that returns anything but 0 ends the run as a failure
 * (LAMELLA_STOPPED: as a stop). Callbacks other than `render` and `write` may be null. */
typedef struct lamella_backend {
    uint32_t struct_size;
    void* user;
    /* Called before the first of the layers from `first` up to, not including, `last`. When flags contain
     * LAMELLA_RESUME, it sets `missing` (initially `first`) to the first layer that is not yet written. */
    int32_t (*begin)(void* user, const lamella_job_info* job, int32_t first, int32_t last, uint32_t flags,
                     int32_t* missing);
    /* Renders a layer. Several threads call it at once, with layers in any order. The context and the
     * section may be used until the callback returns. */
    int32_t (*render)(void* user, lamella_context* context, lamella_section* layer, lamella_product* product);
    /* Writes a rendered layer. Called by one thread, in layer order. */
    int32_t (*write)(void* user, const lamella_section_info* layer, const lamella_product* product);
    /* Called after the last layer if nothing failed. */
    int32_t (*end)(void* user);
    /* Frees the data that `render` made, whether or not it was written. Several threads call it at once. */
    void (*drop)(void* user, void* data);
    /* Returns why a callback failed; may return null. */
    const char* (*error)(void* user);
} lamella_backend;

/* Streams the job's layers to a back-end of the caller's, which must not have been used before. */
LAMELLA_API int32_t lamella_run_backend(lamella_context* context, const lamella_job* job,
                                        const lamella_backend* backend, const lamella_run_options* options,
                                        lamella_run_report* report);

/* ---- Plugins: printers in shared libraries ------------------------------------------------------------ */

/* The machine that a recipe names. */
typedef struct lamella_printer {
    uint32_t struct_size;
    const char* name;        /* name of the profile */
    int32_t columns, rows;   /* pixels of its display */
    double pixel_x, pixel_y; /* mm */
    double tolerance;        /* allowed deviation of contours, mm */
} lamella_printer;

/* The printer that a plugin adds. */
typedef struct lamella_plugin {
    uint32_t struct_size;
    const char* name;        /* name of the printer, for -o PATH@NAME; letters, digits, - and _ */
    const char* description; /* one line */
    const char* ending;      /* file name ending, with the dot; null for none */
    /* Fills in a back-end that writes to `path`; `flags` may contain LAMELLA_FORCE. On failure, writes the
     * reason to `message`, which has room for `size` bytes including the terminating zero. */
    int32_t (*open)(const lamella_printer* printer, const char* path, uint32_t flags,
                    lamella_backend* backend, char* message, size_t size);
    /* Closes a back-end that was opened; no callback of it is called afterwards. */
    void (*close)(lamella_backend* backend);
} lamella_plugin;

/* The function that a plugin's library exports under the name lamella_plugin_entry. It fills in `plugin`,
 * whose struct_size is set. Anything but 0 refuses to be loaded, for example because `abi_version` is not
 * the one that the plugin was built for. */
typedef int32_t (*lamella_plugin_entry_function)(uint32_t abi_version, lamella_plugin* plugin);

#ifdef __cplusplus
}
#endif

#endif
