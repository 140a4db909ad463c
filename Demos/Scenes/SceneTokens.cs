using System;
using System.Globalization;
using System.Numerics;
using System.Text;

namespace Demos.Scenes;

/// <summary>Takes a scene file apart into tokens, and knows the line of each for the error messages.</summary>
ref struct SceneTokens
{
    const int LongestTokenInMessage = 40;

    readonly ReadOnlySpan<byte> text;
    ReadOnlySpan<byte> token;
    int position;
    int line;

    public SceneTokens(ReadOnlySpan<byte> text)
    {
        ReadOnlySpan<byte> byteOrderMark = [0xEF, 0xBB, 0xBF];
        this.text = text.StartsWith(byteOrderMark) ? text[byteOrderMark.Length..] : text;
        line = 1;
    }

    /// <summary>Line of the token read last, from 1.</summary>
    public readonly int Line => line;

    /// <summary>
    /// How many items at most can follow, if each takes the given number of tokens: a bound for what a count in the file may reserve.
    /// </summary>
    public readonly int MostItemsLeft(int tokensPerItem) => (text.Length - position) / (2 * tokensPerItem) + 1;

    /// <summary>Reads one of a few words and returns its index.</summary>
    public int Word(string expectation, params ReadOnlySpan<string> words)
    {
        Next(expectation);
        for (int i = 0; i < words.Length; ++i)
        {
            if (token.SequenceEqual(Encoding.UTF8.GetBytes(words[i])))
                return i;
        }
        throw Expected(expectation);
    }

    /// <summary>Reads the word that has to be here.</summary>
    public void Word(string word) => Word($"'{word}'", word);

    /// <summary>Reads a word that may be anything printable.</summary>
    public string Name(string what)
    {
        Next(what);
        string name;
        try
        {
            name = new UTF8Encoding(false, true).GetString(token);
        }
        catch (DecoderFallbackException)
        {
            throw Wrong($"{what} is not UTF-8");
        }
        foreach (char c in name)
        {
            if (char.IsControl(c))
                throw Wrong($"{what} holds control characters");
        }
        return name;
    }

    /// <summary>Reads a whole number of a range.</summary>
    public int Integer(string what, int minimum, int maximum)
    {
        Next(what);
        if (!int.TryParse(token, NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out int value))
            throw Expected($"{what} (a whole number)");
        if (value < minimum || value > maximum)
        {
            string range = maximum == int.MaxValue ? $"at least {minimum}" : $"{minimum} to {maximum}";
            throw Wrong(maximum < minimum ? $"{what} is {value}, but there are none" : $"{what} is {value}, not {range}");
        }
        return value;
    }

    /// <summary>Reads a finite number.</summary>
    public float Number(string what)
    {
        Next(what);
        if (!float.TryParse(token, NumberStyles.AllowLeadingSign | NumberStyles.AllowDecimalPoint | NumberStyles.AllowExponent,
                CultureInfo.InvariantCulture, out float value))
            throw Expected($"{what} (a number)");
        if (!float.IsFinite(value))
            throw Wrong($"{what} is not finite: '{TokenText()}'");
        return value;
    }

    /// <summary>Reads a finite number that is not negative.</summary>
    public float NotNegative(string what)
    {
        float value = Number(what);
        return value >= 0 ? value : throw Wrong($"{what} is negative: '{TokenText()}'");
    }

    /// <summary>Reads a finite number above zero.</summary>
    public float Positive(string what)
    {
        float value = Number(what);
        return value > 0 ? value : throw Wrong($"{what} is not positive: '{TokenText()}'");
    }

    /// <summary>Reads three finite numbers.</summary>
    public Vector3 Vector(string what) => new(Number(what), Number(what), Number(what));

    /// <summary>Reads x y z w of a rotation. Files round, so that the length is set to one here.</summary>
    public Quaternion Rotation(string what)
    {
        double x = Number(what), y = Number(what), z = Number(what), w = Number(what);
        double length = Math.Sqrt(x * x + y * y + z * z + w * w);
        // Files carry seven decimals: of anything shorter than this only rounding is left.
        if (length < 1e-6)
            throw Wrong($"{what} is a quaternion of length zero");
        return new Quaternion((float)(x / length), (float)(y / length), (float)(z / length), (float)(w / length));
    }

    /// <summary>Fails unless all has been read.</summary>
    public void End()
    {
        if (TryNext())
            throw Expected("the end of the file");
    }

    /// <summary>The error that the token read last is something else than it says.</summary>
    public readonly SceneException Expected(string what) => Wrong($"expected {what}, found '{TokenText()}'");

    /// <summary>The error that the token read last has a value that cannot be.</summary>
    public readonly SceneException Wrong(string problem) => new(line, TokenText(), problem);

    void Next(string what)
    {
        if (!TryNext())
            throw new SceneException(line, "", $"expected {what}, found the end of the file");
    }

    bool TryNext()
    {
        token = default;
        while (position < text.Length && IsSpace(text[position]))
        {
            if (text[position++] == (byte)'\n')
                ++line;
        }
        int start = position;
        while (position < text.Length && !IsSpace(text[position]))
            ++position;
        token = text[start..position];
        return position > start;
    }

    /// <summary>The token as it can be shown: short, and without anything that a terminal would act on.</summary>
    readonly string TokenText()
    {
        var shown = new StringBuilder();
        foreach (char c in Encoding.UTF8.GetString(token[..Math.Min(token.Length, 4 * LongestTokenInMessage)]))
        {
            if (shown.Length == LongestTokenInMessage)
                return shown.Append('…').ToString();
            shown.Append(char.IsControl(c) ? '\uFFFD' : c);
        }
        return shown.ToString();
    }

    static bool IsSpace(byte c) => c is (byte)' ' or (byte)'\n' or (byte)'\r' or (byte)'\t' or (byte)'\v' or (byte)'\f';
}
