/* Lamella in other people's programs: recipes, sections and whole jobs, from C or anything that can call C.
 *
 * Lengths are millimetres in the part's own coordinates, areas mm^2, volumes mm^3. Text is UTF-8 and ends in
 * a zero. Numbers in text have a decimal point whatever the locale.
 *
 * STATUS. A function that can fail returns a status: LAMELLA_OK, or what went wrong. Of its last failure a
 * context tells more: lamella_last_error. No function throws, prints, exits or changes what other code of the
 * process sees. After a failure, out-parameters are as they were, unless it says otherwise.
 *
 * STRUCTS. The first member of every struct is its size in the caller's program. The library neither reads
 * nor writes beyond it, so that programs built against an older header go on working. Clear a struct, then
 * set its struct_size: in C, `lamella_job_info info = {.struct_size = sizeof info};`. Zero in any other
 * member means what is usual.
 *
 * MEMORY. What a function named lamella_..._create, _read, _build, _open or one that makes contours or runs
 * hands out is released by the function named _destroy, which takes a null pointer, too. Other pointers that
 * the library hands out are valid as long as the object that they were asked of, and those given to a
 * callback until the callback returns. The library keeps no pointer of the caller's beyond the call, but for
 * callbacks and their `user`, which are wanted as long as anything made with them lives.
 *
 * THREADS. There is no state beside the objects. A context, a recipe and a section are used by one thread at
 * a time; each thread has its own. A job, contours and runs never change: any number of threads may ask them
 * at once, each with its own context. A cancel token may be set from any thread, and from a signal handler.
 * Callbacks for fields, gradings and the rendering of layers are called by several threads at once. A
 * callback may call the library, with a context of its own.
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

/* Grows when a program built against an older header would no longer work. */
#define LAMELLA_ABI_VERSION 1u

/* Those that are exit codes of the command, too, have the same numbers. */
enum {
    LAMELLA_OK = 0,
    LAMELLA_VIOLATED = 1,      /* a stated constraint does not hold */
    LAMELLA_BAD_INPUT = 2,     /* a file, a key or a value is wrong */
    LAMELLA_FAULT = 3,         /* the disk is full, the printer is gone, a callback failed */
    LAMELLA_BAD_CALL = 4,      /* a null pointer, a size or a number that no call should have */
    LAMELLA_OUT_OF_MEMORY = 5, /* there is not enough memory */
    LAMELLA_STOPPED = 130      /* a cancel token was set, or a callback asked to stop */
};

/* The version of the interface that the library has; compare it with LAMELLA_ABI_VERSION. */
LAMELLA_API uint32_t lamella_abi_version(void);
/* The version of the library, "0.1.0". */
LAMELLA_API const char* lamella_version(void);
/* A word for a status: "ok", "bad input", ... */
LAMELLA_API const char* lamella_status_name(int32_t status);

/* ---- Contexts: what a thread needs to call ---------------------------------------------------------- */

typedef struct lamella_context lamella_context;

typedef struct lamella_error {
    uint32_t struct_size;
    int32_t status;      /* LAMELLA_OK when nothing has failed yet */
    const char* message; /* what was wrong and what would be right; a line for each mistake of a recipe */
    const char* path;    /* the recipe of the first mistake; "" when it is not about a recipe's line */
    int32_t line;        /* in that recipe, counted from 1; 0 when it is not about a line */
} lamella_error;

/* Makes a context. `abi_version` is LAMELLA_ABI_VERSION: LAMELLA_BAD_CALL when the library has another. */
LAMELLA_API int32_t lamella_context_create(uint32_t abi_version, lamella_context** context);
LAMELLA_API void lamella_context_destroy(lamella_context* context);
/* The last failure of a call with this context. Its texts are valid until the next call with it. */
LAMELLA_API int32_t lamella_last_error(const lamella_context* context, lamella_error* error);

/* ---- Cancel tokens: stopping long work -------------------------------------------------------------- */

typedef struct lamella_cancel lamella_cancel;

LAMELLA_API int32_t lamella_cancel_create(lamella_context* context, lamella_cancel** cancel);
/* Only once nothing uses it any more. */
LAMELLA_API void lamella_cancel_destroy(lamella_cancel* cancel);
/* Asks all work that has this token to stop. From any thread or signal handler. Work looks at its token every
 * few milliseconds, between the steps of a layer too; single steps of the heaviest layers take some tens. */
LAMELLA_API void lamella_cancel_request(lamella_cancel* cancel);

/* ---- Recipes: what to make -------------------------------------------------------------------------- */

typedef struct lamella_recipe lamella_recipe;

/* An empty recipe. */
LAMELLA_API int32_t lamella_recipe_create(lamella_context* context, lamella_recipe** recipe);
LAMELLA_API void lamella_recipe_destroy(lamella_recipe* recipe);
/* Reads a recipe (.toml), or takes a model (.stl, .obj, .ply, .3mf) as the part. A recipe that is no TOML or
 * cannot be read fails here; all other mistakes are told of together, when a job is built. */
LAMELLA_API int32_t lamella_recipe_read(lamella_context* context, const char* path, lamella_recipe** recipe);
/* Adds the sections of a recipe's text of `size` bytes; what it sets anew replaces what was set. `name`
 * stands for the text in messages; relative paths in it start in the folder of `name`. */
LAMELLA_API int32_t lamella_recipe_add_text(lamella_context* context, lamella_recipe* recipe,
                                            const char* text, size_t size, const char* name);
/* Sets a key that the command has a flag for: "foam.cell" to "2.5 + 0.1*z". It comes before what texts say.
 * A key that there is none of is LAMELLA_BAD_INPUT at once, a wrong value when a job is built. */
LAMELLA_API int32_t lamella_recipe_set(lamella_context* context, lamella_recipe* recipe, const char* key,
                                       const char* value);
/* A folder of machine profiles besides the built-in ones; null: that of the user. */
LAMELLA_API int32_t lamella_recipe_add_printers(lamella_context* context, lamella_recipe* recipe,
                                                const char* folder);

/* What the caller's field says about the distance to its surface. */
enum {
    LAMELLA_SIGN = 0,  /* only the sign holds; slow, as every place has to be looked at */
    LAMELLA_BOUND = 1, /* it changes by at most 1 per mm */
    LAMELLA_EXACT = 2  /* it is the signed Euclidean distance, mm */
};

/* Encloses all values in the box from lower to upper (x, y, z each): sets least and greatest, which may be
 * infinite, or further apart than they need be. Several threads call it at once. */
typedef int32_t (*lamella_range)(void* user, const double* lower, const double* upper, double* least,
                                 double* greatest);

/* A solid of the caller's: where `values` is below zero. */
typedef struct lamella_field {
    uint32_t struct_size;
    int32_t metric;            /* LAMELLA_SIGN, LAMELLA_BOUND or LAMELLA_EXACT */
    double lower[3], upper[3]; /* a box that holds the solid, mm; beyond it there is nothing */
    /* Values at `count` points (x, y, z each, mm) to `values`; anything but 0 is a failure. Several threads
     * call it at once. The same point has to get the same value each time. */
    int32_t (*values)(void* user, const double* points, size_t count, double* values);
    void* user;
    /* Tells this function from others: jobs that are equal but for it must make the same layers where it is
     * equal, and need not where it is not. By it a stopped run is known again. Not null. */
    const char* identity;
    lamella_range range; /* may be null: then the metric has to do */
} lamella_field;

/* A number of the caller's that varies in space. */
typedef struct lamella_grading {
    uint32_t struct_size;
    double least, greatest; /* values beyond these are taken for these */
    int32_t (*values)(void* user, const double* points, size_t count, double* values); /* as of a field */
    void* user;
    const char* identity; /* as of a field */
    /* May be null: then foams are built for anything from least to greatest everywhere, which takes the
     * longer the further these are apart. With it, they are the ones that the same formula makes. */
    lamella_range range;
} lamella_grading;

/* A mesh of the caller's, which is copied. Holes are closed and mistakes mended as of a mesh file. */
typedef struct lamella_mesh {
    uint32_t struct_size;
    const double* vertices; /* x, y, z each, mm */
    size_t vertex_count;
    const uint32_t* triangles; /* three vertices each, counter-clockwise seen from outside */
    size_t triangle_count;
} lamella_mesh;

/* Give the recipe a solid under a name, as a [[field]] would: it is the part when it is the only one, and
 * "part.field" or regions may name it. A recipe's text may have declared it: kind = "host". */
LAMELLA_API int32_t lamella_recipe_add_field(lamella_context* context, lamella_recipe* recipe,
                                             const char* name, const lamella_field* field);
LAMELLA_API int32_t lamella_recipe_add_mesh(lamella_context* context, lamella_recipe* recipe,
                                            const char* name, const lamella_mesh* mesh);
/* Gives the recipe a number that formulas name, as a [[grading]] would. */
LAMELLA_API int32_t lamella_recipe_add_grading(lamella_context* context, lamella_recipe* recipe,
                                               const char* name, const lamella_grading* grading);

/* ---- Jobs: a recipe made ----------------------------------------------------------------------------- */

typedef struct lamella_job lamella_job;

/* Progress of work: anything but 0 stops it. `what`: "layers", "islands", "repairs" or "supports". */
typedef int32_t (*lamella_on_progress)(void* user, const char* what, int32_t done, int32_t total);

typedef struct lamella_build_options {
    uint32_t struct_size;
    int32_t threads;        /* 0: one per core */
    lamella_cancel* cancel; /* may be null */
    lamella_on_progress
        progress; /* of surveys before the first layer, if the recipe needs any; may be null */
    void* user;
    const char* plans; /* folder where plans of supports are kept for later runs; null: nowhere */
} lamella_build_options;

typedef struct lamella_job_info {
    uint32_t struct_size;
    int32_t layer_count;
    double lower[3], upper[3]; /* bounds of part and supports; the bed lies at lower[2] */
    double layer_height;       /* mm */
    int32_t has_supports;      /* 1 or 0 */
    const char* name;          /* of the part */
    const char* identity;      /* 32 digits: jobs that share them make the same layers */
} lamella_job_info;

/* Makes a recipe's job; the recipe may be changed or destroyed then. `options` may be null. */
LAMELLA_API int32_t lamella_job_build(lamella_context* context, const lamella_recipe* recipe,
                                      const lamella_build_options* options, lamella_job** job);
/* What was made of the job and still lives keeps what it needs of it. */
LAMELLA_API void lamella_job_destroy(lamella_job* job);
LAMELLA_API int32_t lamella_job_info_get(lamella_context* context, const lamella_job* job,
                                         lamella_job_info* info);
/* The height at which a layer is cut, half-way up: mm in part coordinates. */
LAMELLA_API int32_t lamella_job_layer_z(lamella_context* context, const lamella_job* job, int32_t layer,
                                        double* z);
/* The part's field at `count` points (x, y, z each, mm): below zero inside. */
LAMELLA_API int32_t lamella_job_values(lamella_context* context, const lamella_job* job, const double* points,
                                       size_t count, double* values);

/* ---- Sections: a job at one height ------------------------------------------------------------------- */

typedef struct lamella_section lamella_section;

/* Of what: may be added. */
enum { LAMELLA_PART = 1, LAMELLA_SUPPORTS = 2 };

typedef struct lamella_section_info {
    uint32_t struct_size;
    int32_t layer;    /* -1 where the section was opened at a height */
    double z;         /* mm */
    double thickness; /* of a layer, mm */
    double lower[2],
        upper[2]; /* a rectangle that holds part and supports; lower > upper where there is none */
} lamella_section_info;

/* Cuts the job at any height, mm in part coordinates. */
LAMELLA_API int32_t lamella_section_open(lamella_context* context, const lamella_job* job, double z,
                                         lamella_section** section);
/* Cuts the job where a layer is cut. */
LAMELLA_API int32_t lamella_section_open_layer(lamella_context* context, const lamella_job* job,
                                               int32_t layer, lamella_section** section);
LAMELLA_API void lamella_section_destroy(lamella_section* section);
LAMELLA_API int32_t lamella_section_info_get(lamella_context* context, const lamella_section* section,
                                             lamella_section_info* info);

/* Pixels of the plane: the corner of pixel (column 0, row 0), and the way to the next ones. */
typedef struct lamella_raster {
    uint32_t struct_size;
    int32_t columns, rows;
    int32_t lines;           /* per row, whose mean counts; 0: only whether a pixel's centre is solid */
    double x, y;             /* mm */
    double pitch_x, pitch_y; /* mm from column to column and from row to row; negative to mirror */
} lamella_raster;

/* How much of each pixel is solid, 0 to 255, to `pixels`: row by row, `stride` bytes from one to the next (0:
 * as many as there are columns). */
LAMELLA_API int32_t lamella_section_coverage(lamella_context* context, lamella_section* section, int32_t what,
                                             const lamella_raster* raster, uint8_t* pixels, size_t stride);

/* The solid runs of every line of a raster. */
typedef struct lamella_runs lamella_runs;
typedef struct lamella_runs_view {
    uint32_t struct_size;
    size_t line_count;   /* rows times lines per row */
    const size_t* first; /* of each line its first run; line_count + 1 of them */
    const int32_t* ends; /* begin and end of each run along its line, half-open, in 1/256 of a column */
} lamella_runs_view;

LAMELLA_API int32_t lamella_section_runs(lamella_context* context, lamella_section* section, int32_t what,
                                         const lamella_raster* raster, lamella_runs** runs);
LAMELLA_API void lamella_runs_destroy(lamella_runs* runs);
LAMELLA_API int32_t lamella_runs_view_get(lamella_context* context, const lamella_runs* runs,
                                          lamella_runs_view* view);

/* Closed polygons that never cross: outer ones counter-clockwise, holes clockwise. */
typedef struct lamella_contours lamella_contours;
typedef struct lamella_contours_view {
    uint32_t struct_size;
    size_t count;          /* of contours */
    const size_t* first;   /* of each contour its first point; count + 1 of them */
    const double* points;  /* x, y each, mm; the first point is not repeated */
    const int32_t* parent; /* the contour directly about this one; -1 where there is none */
    double area;           /* of all, holes taken off, mm^2 */
} lamella_contours_view;

/* Contours that leave the solid's border by at most `tolerance`, mm. */
LAMELLA_API int32_t lamella_section_contours(lamella_context* context, lamella_section* section, int32_t what,
                                             double tolerance, lamella_contours** contours);

/* Polygons of the caller's; what lies inside an odd number of them is inside. */
typedef struct lamella_polygons {
    uint32_t struct_size;
    size_t count;         /* of polygons */
    const size_t* first;  /* of each polygon its first point; count + 1 of them */
    const double* points; /* x, y each, mm */
} lamella_polygons;

/* What of the section lies inside the polygons: they are filled with the job's foam, at this height. */
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
    int32_t first, last;          /* layers from first up to, not including, last; both 0: all */
    uint32_t flags;               /* LAMELLA_RESUME, LAMELLA_FORCE */
    lamella_cancel* cancel;       /* may be null */
    lamella_on_progress progress; /* called by one thread after each layer; may be null */
    void* user;
} lamella_run_options;

typedef struct lamella_run_report {
    uint32_t struct_size;
    int32_t layers_written;
    int32_t layers_kept;   /* found finished when continuing */
    double volume;         /* material of the part in the layers written, mm^3 */
    double support_volume; /* of its supports */
} lamella_run_report;

/* Streams the job's layers to a file or folder, as `lamella slice -o` does: PATH, or PATH@PROFILE for another
 * machine than the recipe's; a path's ending that belongs to a back-end chooses it. `options` and `report`
 * may be null. A run that is stopped or fails leaves what it has under an unfinished name, for
 * LAMELLA_RESUME. Messages speak of the command's flags: --output is `output`, --resume and --force are the
 * `flags` of the options. */
LAMELLA_API int32_t lamella_run(lamella_context* context, const lamella_job* job, const char* output,
                                const lamella_run_options* options, lamella_run_report* report);

/* What a back-end of the caller's made of a layer. */
typedef struct lamella_product {
    uint32_t struct_size;
    void* data;          /* the caller's own; handed to `write`, then to `drop` */
    double area;         /* solid area of the part, mm^2, for the report; 0 when it is not known */
    double support_area; /* of its supports */
} lamella_product;

/* A back-end of the caller's. Anything but 0 from a callback is a failure (LAMELLA_STOPPED: a stop) that ends
 * the run. Callbacks may be null but for render and write. */
typedef struct lamella_backend {
    uint32_t struct_size;
    void* user;
    /* Before the first layer of those from `first` up to `last`. Where flags have LAMELLA_RESUME, sets
     * `missing` (which is `first`) to the first layer that is not there yet. */
    int32_t (*begin)(void* user, const lamella_job_info* job, int32_t first, int32_t last, uint32_t flags,
                     int32_t* missing);
    /* Computes what will be written of a layer: several threads at once, layers in any order. The context and
     * the section are the callback's until it returns. */
    int32_t (*render)(void* user, lamella_context* context, lamella_section* layer, lamella_product* product);
    /* Writes a layer: one thread, layers in order. */
    int32_t (*write)(void* user, const lamella_section_info* layer, const lamella_product* product);
    /* After the last layer, when all went well. */
    int32_t (*end)(void* user);
    /* Frees what `render` made, whether or not it was written. Several threads at once. */
    void (*drop)(void* user, void* data);
    /* What went wrong when a callback failed; may return null. */
    const char* (*error)(void* user);
} lamella_backend;

/* Streams the job's layers to a back-end of the caller's, which has to be as good as new. */
LAMELLA_API int32_t lamella_run_backend(lamella_context* context, const lamella_job* job,
                                        const lamella_backend* backend, const lamella_run_options* options,
                                        lamella_run_report* report);

/* ---- Plugins: printers in shared libraries ------------------------------------------------------------ */

/* The machine that a recipe names. */
typedef struct lamella_printer {
    uint32_t struct_size;
    const char* name;        /* of the profile */
    int32_t columns, rows;   /* of its display */
    double pixel_x, pixel_y; /* mm */
    double tolerance;        /* of contours, mm */
} lamella_printer;

/* What a plugin adds. */
typedef struct lamella_plugin {
    uint32_t struct_size;
    const char* name;        /* of the printer, for -o PATH@NAME; letters, digits, - and _ */
    const char* description; /* one line */
    const char* ending;      /* of its files, with the dot; null for none */
    /* Fills in a back-end that writes to `path`; `flags` may have LAMELLA_FORCE. On failure `message` (of
     * `size` bytes, zero included) takes what was wrong. */
    int32_t (*open)(const lamella_printer* printer, const char* path, uint32_t flags,
                    lamella_backend* backend, char* message, size_t size);
    /* The last call for a back-end that was opened. */
    void (*close)(lamella_backend* backend);
} lamella_plugin;

/* What a plugin's library exports, named lamella_plugin_entry: fills in `plugin`, whose struct_size is set.
 * Anything but 0 refuses to be loaded, as where `abi_version` is not the one it was built for. */
typedef int32_t (*lamella_plugin_entry_function)(uint32_t abi_version, lamella_plugin* plugin);

#ifdef __cplusplus
}
#endif

#endif
