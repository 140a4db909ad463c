using System;

namespace BepuPhysics;

/// <summary>A constraint as its body knows it.</summary>
public struct BodyConstraintReference
{
    /// <summary>The constraint.</summary>
    public ConstraintHandle ConnectingConstraintHandle;
    /// <summary>Which of the constraint's bodies this one is.</summary>
    public int BodyIndexInConstraint;
}

/// <summary>The constraints of a body, contacts included, in the order in which they were added. Valid until constraints are added or removed.</summary>
public readonly struct BodyConstraints
{
    readonly Solver solver;
    readonly ConstraintList list;

    internal BodyConstraints(Solver solver, ConstraintList list)
    {
        this.solver = solver;
        this.list = list;
    }

    /// <summary>Number of constraints.</summary>
    public int Count => list.Count;

    /// <summary>A constraint by its place in the order. Goes through the ones before it: to visit all, use foreach.</summary>
    /// <exception cref="ArgumentOutOfRangeException">There are not as many.</exception>
    public BodyConstraintReference this[int index]
    {
        get
        {
            if ((uint)index >= (uint)Count)
                throw new ArgumentOutOfRangeException(nameof(index), index, $"The body has {Count} constraints.");
            var edge = list.First;
            for (int i = 0; i < index; ++i)
                edge = solver.Edges.Next(edge);
            return solver.ReferenceOf(edge);
        }
    }

    /// <summary>Begins to visit all.</summary>
    public Enumerator GetEnumerator() => new(solver, list);

    /// <summary>Visits the constraints of a body.</summary>
    public struct Enumerator
    {
        readonly Solver solver;
        int next;
        int left;

        internal Enumerator(Solver solver, ConstraintList list)
        {
            this.solver = solver;
            next = list.First;
            left = list.Count;
        }

        /// <summary>The constraint at which the visit is.</summary>
        public BodyConstraintReference Current { get; private set; }

        /// <summary>Goes on to the next constraint.</summary>
        /// <returns>Whether there is one.</returns>
        public bool MoveNext()
        {
            if (left == 0)
                return false;
            --left;
            Current = solver.ReferenceOf(next);
            next = solver.Edges.Next(next);
            return true;
        }
    }
}
