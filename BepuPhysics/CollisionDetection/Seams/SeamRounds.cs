using BepuUtilities.Memory;

namespace BepuPhysics.CollisionDetection;

/// <summary>Makes sets of children agree, side by side: each round looks at the tests that all of them want next, so that bundles are full.</summary>
/// <remarks>A set changes nothing of another. Which of them are worked on together changes no bit.</remarks>
static class SeamRounds
{
    /// <summary>Works on all sets until each is done.</summary>
    public static void Run(ref SeamMemory memory, BufferPool pool)
    {
        while (true)
        {
            for (int i = 0; i < memory.Sets.Count; ++i)
                Advance(ref memory, ref memory.Sets[i], pool);
            if (memory.Tests.Count == 0)
                return;
            memory.Tests.Execute();
        }
    }

    static void Advance(ref SeamMemory memory, ref SeamSet set, BufferPool pool)
    {
        var first = memory.Tests.Count;
        while (set.Stage != SeamStage.Done && memory.Tests.Count == first)
        {
            Advance(ref memory, ref set, new SeamView(ref set, memory.Touching.AsSpan()), pool);
            set.Tests = new(first, memory.Tests.Count - first);
        }
    }

    static void Advance(ref SeamMemory memory, ref SeamSet set, SeamView view, BufferPool pool)
    {
        switch (set.Stage)
        {
            case SeamStage.DirectionsOfB or SeamStage.DirectionsOfA:
                TriangleNeighbours.AddDirections(ref memory.Tests, view, set.Stage == SeamStage.DirectionsOfA, pool);
                ++set.Stage;
                break;
            case SeamStage.ChoiceOfB or SeamStage.ChoiceOfA:
                TriangleNeighbours.AddChoice(ref memory.Tests, view, pool);
                ++set.Stage;
                break;
            case SeamStage.NormalsOfB or SeamStage.NormalsOfA:
                TriangleNeighbours.Take(memory.Tests, view, set.Stage == SeamStage.NormalsOfA);
                ++set.Stage;
                break;
            case SeamStage.Order:
                ChildAgreement.Begin(view);
                break;
            default:
                ChildAgreement.Advance(ref memory.Tests, view, pool);
                break;
        }
    }
}
