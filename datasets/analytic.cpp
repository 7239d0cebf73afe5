// Generators of analytic fields.
